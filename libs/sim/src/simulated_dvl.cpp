#include <posidonia/sim/simulated_dvl.h>

#include "make_observation.h"

namespace posidonia
{
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Eigen::Vector4d;

namespace
{
double drawnScale(
	const std::string& label, const TDvlSpec& nominal, const TSimulatedDvlOptions& options,
	const TCalibrationErrorOptions& errors, uint64_t seed)
{
	const double drawn = nominal.sigma_scale * CNoise(seedOf(seed, label + " scale")).normal();
	return 1 + errors.dvl_scale + (options.random_scale ? drawn : 0);
}
}  // namespace

CSimulatedDvl::CSimulatedDvl(
	const std::string& label, const TDvlSpec& nominal, const TSimulatedDvlOptions& options,
	const TCalibrationErrorOptions& errors, std::shared_ptr<const CSeaFloor> floor, uint64_t seed)
	: m_label(label),
	  m_nominal(nominal),
	  m_options(options),
	  m_T_body_dvl(trueDvlPose(nominal, errors)),
	  m_scale(drawnScale(label, nominal, options, errors, seed)),
	  m_floor(std::move(floor)),
	  m_beams(nominal.beams()),
	  m_noise(seedOf(seed, label)),
	  m_outliers(seedOf(seed, label + " outliers")),
	  m_losses(seedOf(seed, label + " beam loss"))
{
}

mrpt::obs::CObservation::Ptr CSimulatedDvl::measure(const TVehicleState& state, double stamp)
{
	if (!m_start) m_start = stamp;
	auto dvl = makeObservation<CObservationDVL>(m_label, stamp, m_nominal.T_body_sensor());
	measureVelocities(state, *dvl);
	measureRanges(state, *dvl);
	loseBeams(state, stamp - *m_start, *dvl);
	solveVelocity(*dvl);
	return dvl;
}

Vector3d CSimulatedDvl::trueVelocity(const TVehicleState& state) const
{
	const Vector3d lever = m_T_body_dvl.translation();
	return m_T_body_dvl.linear().transpose() * (state.v_body + state.omega_body.cross(lever));
}

double CSimulatedDvl::trueAltitude(const TVehicleState& state) const
{
	const Vector3d head = state.T_map_body * m_T_body_dvl.translation();
	return m_floor->depthAt(head.head<2>()) - head.z();
}

Vector4d CSimulatedDvl::trueRanges(const TVehicleState& state) const
{
	const Matrix3d R_map_dvl = state.T_map_body.linear() * m_T_body_dvl.linear();
	const Vector3d head = state.T_map_body * m_T_body_dvl.translation();
	Vector4d ranges;
	for (int i = 0; i < 4; i++)
		ranges[i] = m_floor->rangeAlong(head, R_map_dvl * m_beams.col(i));
	return ranges;
}

Vector3d CSimulatedDvl::drawOutlier()
{
	const bool outlier = m_outliers.uniform(0, 1) < m_options.outlier_rate;
	const Vector3d direction = m_outliers.normals<3>().normalized();
	return outlier ? Vector3d(m_options.outlier_speed * direction) : Vector3d(0, 0, 0);
}

/** The beams y = B' v + n, n white with sigma_b = sigmaBeam() each, drawn through their least-squares
 * solution. B (3x4, beams as columns) has orthogonal rows whatever the azimuth of the first beam, for the
 * beams are 90 deg apart: B B' = diag(2 s^2, 2 s^2, 4 c^2), s and c the sine and cosine of the beam angle,
 * and B u = 0 for the unit vector u = (1, -1, 1, -1) / 2. So the four numbers (B B')^-1 B n and u' n are
 * independent, with variances sigma_b^2 / (2 s^2) = sigma_velocity^2 twice, sigma_b^2 / (4 c^2) =
 * sigmaAlong()^2, sigma_b^2; and n = B' (B B')^-1 B n + u u' n turns four such numbers back to white beams.
 * (u' n / 2 is the "error velocity" of a Janus head, which the axes don't see.) */
void CSimulatedDvl::measureVelocities(const TVehicleState& state, CObservationDVL& dvl)
{
	const Vector3d sigma(m_nominal.sigma_velocity, m_nominal.sigma_velocity, m_nominal.sigmaAlong());
	const Vector3d noise = sigma.cwiseProduct(m_noise.normals<3>());
	const Vector3d v = m_scale * trueVelocity(state) + noise + drawOutlier();
	const double error_velocity = m_nominal.sigmaBeam() * m_noise.normal() / 2;
	dvl.velocity = {v.x(), v.y(), v.z()};
	dvl.velocity_valid = true;
	dvl.beam_velocities.resize(4);
	for (int i = 0; i < 4; i++)
		dvl.beam_velocities[i] = m_beams.col(i).dot(v) + (i % 2 == 0 ? error_velocity : -error_velocity);
}

void CSimulatedDvl::measureRanges(const TVehicleState& state, CObservationDVL& dvl)
{
	const Vector4d ranges = trueRanges(state);
	dvl.beam_ranges.resize(4);
	for (int i = 0; i < 4; i++)
		dvl.beam_ranges[i] = ranges[i] + m_options.sigma_altitude * m_noise.normal();
	dvl.altitude = trueAltitude(state) + m_options.sigma_altitude * m_noise.normal();
	dvl.altitude_valid = true;
}

bool CSimulatedDvl::hasLock(double altitude, double time) const
{
	const double since_loss = time - m_options.lock_loss_start;
	const bool lost = since_loss >= 0 && since_loss < m_options.lock_loss_duration;
	return altitude >= m_options.min_altitude && altitude <= m_options.max_altitude && !lost;
}

void CSimulatedDvl::loseBeams(const TVehicleState& state, double time, CObservationDVL& dvl)
{
	const bool lock = hasLock(trueAltitude(state), time);
	const Vector4d ranges = trueRanges(state);
	dvl.altitude_valid = false;
	for (int i = 0; i < 4; i++) {
		const bool returns = m_losses.uniform(0, 1) >= m_options.beam_loss;	 // drawn in any case
		if (lock && returns && ranges[i] <= m_options.max_slant_range)
			dvl.altitude_valid = true;	// one range is enough
		else
			dvl.beam_velocities[i] = dvl.beam_ranges[i] = std::nan("");
	}
	if (!dvl.altitude_valid) dvl.altitude = 0;
}

void CSimulatedDvl::solveVelocity(CObservationDVL& dvl) const
{
	int left = 0;
	Matrix3d normal = Matrix3d::Zero();
	Vector3d right = Vector3d::Zero();
	for (int i = 0; i < 4; i++) {
		if (std::isnan(dvl.beam_velocities[i])) continue;
		left++;
		normal += m_beams.col(i) * m_beams.col(i).transpose();
		right += m_beams.col(i) * dvl.beam_velocities[i];
	}
	if (left == 4) return;	// the vector is their solution already
	dvl.velocity_valid = left == 3;
	const Matrix3d cofactor = left == 3 ? Matrix3d(normal.inverse()) : Matrix3d(Matrix3d::Zero());
	const Vector3d v = cofactor * right;
	dvl.velocity = {v.x(), v.y(), v.z()};
	dvl.velocity_covariance.asEigen() = m_nominal.sigmaBeam() * m_nominal.sigmaBeam() * cofactor;
}
}  // namespace posidonia
