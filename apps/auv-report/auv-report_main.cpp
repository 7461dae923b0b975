#include <posidonia/apps/CReportApp.h>

int main(int argc, char** argv)
{
	return posidonia::runApp<posidonia::CReportApp>(argc, argv);
}
