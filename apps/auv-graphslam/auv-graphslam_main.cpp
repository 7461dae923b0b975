#include <posidonia/apps/CGraphSlamApp.h>

int main(int argc, char** argv)
{
	return posidonia::runApp<posidonia::CGraphSlamApp>(argc, argv);
}
