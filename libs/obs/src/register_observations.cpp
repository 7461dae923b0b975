#include <mrpt/core/initializer.h>
#include <mrpt/rtti/CObject.h>
#include <posidonia/obs/CObservationDVL.h>
#include <posidonia/obs/CObservationPressure.h>
#include <posidonia/obs/register_observations.h>

void posidonia::registerObservations()
{
	mrpt::rtti::registerClass(CLASS_ID(posidonia::CObservationDVL));
	mrpt::rtti::registerClass(CLASS_ID(posidonia::CObservationPressure));
}

MRPT_INITIALIZER(registerAllClasses_posidonia_obs)
{
	posidonia::registerObservations();
}
