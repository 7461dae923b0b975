#include <posidonia/apps/CEvalApp.h>

int main(int argc, char** argv)
{
	return posidonia::runApp<posidonia::CEvalApp>(argc, argv);
}
