#pragma once

/** One class a sensor: the law of the instrument, its errors and nothing else. `measure` is called once for
 * each instant in order of time, 1/rate apart, from the start on (errors that walk or wander advance by
 * 1/rate a call), with the true state; `stamp` is UTC [s].
 *
 * Accessors of drawn errors tell those of the reading that measure() gave last; before the first call, those
 * that the first reading will have. The law of each error is that of the sensor's spec (sensor_suite.h), so
 * that a filter may model exactly what is simulated. */
#include <posidonia/sim/simulated_ahrs.h>
#include <posidonia/sim/simulated_dvl.h>
#include <posidonia/sim/simulated_gps.h>
#include <posidonia/sim/simulated_imu.h>
#include <posidonia/sim/simulated_pressure.h>
