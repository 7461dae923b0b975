#include <posidonia/apps/CSimApp.h>

int main(int argc, char** argv)
{
	return posidonia::runApp<posidonia::CSimApp>(argc, argv);
}
