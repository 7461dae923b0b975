#pragma once

#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/sim/vehicle_dynamics.h>

#include <limits>

namespace posidonia::testing
{
inline constexpr double kNoFloor = std::numeric_limits<double>::infinity();

inline Eigen::Isometry3d poseAt(double depth)
{
	Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
	T.translation().z() = depth;
	return T;
}
/** SPARUS II in still water without a floor. */
inline CVehicleDynamics makeVehicle(double depth, const TVehicleOptions& options = {})
{
	return {options, {}, {}, kNoFloor, 1, poseAt(depth)};
}
/** State at t, having gone there. */
inline TVehicleState stateAfter(CVehicleDynamics& vehicle, double t)
{
	vehicle.advanceTo(t);
	return vehicle.stateAt(t);
}
inline Vector6d velocityOf(const TVehicleState& s)
{
	Vector6d nu;
	nu << s.v_body, s.omega_body;
	return nu;
}

/** Neither lift nor damping: the water only carries and takes along. */
inline TVehicleOptions idealFluid()
{
	TVehicleOptions o;
	o.linear_damping = o.quadratic_damping = std::vector<double>(6, 0.0);
	o.stern_lift = 0;
	return o;
}

/** Does `make` throw a CError that says all of `words`? */
template <class MAKE>
void expectRefused(MAKE&& make, const std::vector<std::string>& words)
{
	try {
		make();
		ADD_FAILURE() << "nothing was refused; expected: " << words.front();
	}
	catch (const CError& error) {
		for (const auto& word : words)
			EXPECT_NE(std::string(error.what()).find(word), std::string::npos)
				<< "'" << word << "' is not in: " << error.what();
	}
}
}  // namespace posidonia::testing
