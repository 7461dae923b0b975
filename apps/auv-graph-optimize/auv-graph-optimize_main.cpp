#include <posidonia/apps/CGraphOptimizeApp.h>

int main(int argc, char** argv)
{
	return posidonia::runApp<posidonia::CGraphOptimizeApp>(argc, argv);
}
