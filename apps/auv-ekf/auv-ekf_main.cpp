#include <posidonia/apps/CEkfApp.h>

int main(int argc, char** argv)
{
	return posidonia::runApp<posidonia::CEkfApp>(argc, argv);
}
