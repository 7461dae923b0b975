#include <posidonia/apps/CMissionApp.h>

int main(int argc, char** argv)
{
	return posidonia::runApp<posidonia::CMissionApp>(argc, argv);
}
