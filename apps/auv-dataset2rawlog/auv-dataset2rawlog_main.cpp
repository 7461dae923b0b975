#include <posidonia/apps/CDatasetApp.h>

int main(int argc, char** argv)
{
	return posidonia::runApp<posidonia::CDatasetApp>(argc, argv);
}
