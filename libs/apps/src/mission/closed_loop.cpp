#include <posidonia/apps/mission/closed_loop.h>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;
using mrpt::obs::CObservationStereoImages;
using mrpt::system::CTimeLoggerEntry;

CClosedLoop::CClosedLoop(
	const TOptions& options, CSimulatedVehicle& vehicle, CVehicleComputer& computer,
	CMissionRecorder& recorder)
	: m_options(options), m_vehicle(vehicle), m_computer(computer), m_recorder(recorder)
{
	m_timer.setMinLoggingLevel(mrpt::system::LVL_ERROR);  // else it prints itself when it dies
}

void CClosedLoop::run(const TListeners& listeners)
{
	for (bool finished = false; !finished;) {
		while (m_vehicle.nextTime() <= double(m_steps) / m_options.loop.control_rate)
			sense(listeners);
		const TControlStep step = control();
		listeners.step(step);
		finished = step.output.finished || listeners.stops();
	}
}

void CClosedLoop::sense(const TListeners& listeners)
{
	CSimulatedVehicle::TMeasurement measurement;
	{
		const CTimeLoggerEntry timing(m_timer, "vehicle and sensors");
		measurement = m_vehicle.measure();
	}
	if (!measurement.observation || !takes(measurement)) return;
	if (measurement.frame) {
		takePair(measurement);
		listeners.pair();
	}
	else
		m_computer.add(m_recorder.write(*measurement.observation));
}

/** The camera is triggered by the way travelled: no picture is taken that no one looks at. */
bool CClosedLoop::takes(const CSimulatedVehicle::TMeasurement& measurement)
{
	return !measurement.frame || m_options.all_pictures || m_computer.wantsPair();
}

void CClosedLoop::takePair(const CSimulatedVehicle::TMeasurement& pair)
{
	TGreyPair pictures;
	{
		const CTimeLoggerEntry timing(m_timer, "rendering");
		pictures = m_vehicle.photograph(pair);
	}
	auto logged = std::dynamic_pointer_cast<CObservationStereoImages>(m_recorder.write(*pair.observation));
	m_recorder.write(*logged, pictures);
	if (m_options.save_depth) m_recorder.writeDepths(*logged, m_vehicle.depths(pair));
	m_recorder.writeTruth(stampOf(*logged), pair.truth.T_map_body);
	logged->imageLeft = mrpt::img::CImage(pictures.left, mrpt::img::DEEP_COPY);
	logged->imageRight = mrpt::img::CImage(pictures.right, mrpt::img::DEEP_COPY);
	m_computer.add(logged);
}

TControlStep CClosedLoop::control()
{
	const CTimeLoggerEntry timing(m_timer, "control");
	TControlStep step;
	step.t = double(m_steps++) / m_options.loop.control_rate;
	step.truth = m_vehicle.moveTo(step.t);
	if (m_options.forced.time > 0 && step.t >= m_options.forced.time && !m_forced)
		forceCorrection(step.truth);
	step.feedback = m_computer.feedback(m_options.start_time + step.t);
	step.output = m_computer.step(chosen(step.feedback, step.truth));
	describe(step);
	const TThrusters& set = step.output.set_points;
	m_vehicle.setSetPoints({set.starboard, set.port, set.heave});
	m_recorder.write(step.output, step.feedback.navigation);
	m_recorder.writeTruth(m_options.start_time + step.t, step.truth.T_map_body);
	return step;
}

/** What the record of a step holds besides. */
void CClosedLoop::describe(TControlStep& step)
{
	const Vector3d position = step.truth.T_map_body.translation();
	step.true_altitude = m_vehicle.scene().floor()->depthAt(position.head<2>()) - position.z();
	const CStereoSlam& slam = m_computer.slam();
	if (slam.odometry().ready()) step.T_odom_body = slam.odometry().now().T;
	const auto& edges = slam.map().edges();
	for (; m_edges_counted < edges.size(); m_edges_counted++)
		m_loops += edges[m_edges_counted].kind == EEdgeKind::ROI;
	step.loops = m_loops;
	step.faults = m_vehicle.faults().active(step.t);
}

/** pose_source = truth puts the true pose in the place of the estimated one; velocities stay measured. */
TControlState CClosedLoop::chosen(const TPoseFeedback& feedback, const TVehicleState& truth) const
{
	TControlState navigation = feedback.navigation;
	if (m_options.loop.pose_source == "truth") navigation.T_map_body = truth.T_map_body;
	return navigation;
}

/** Turns and shifts the map about the vehicle. */
void CClosedLoop::forceCorrection(const TVehicleState& truth)
{
	const auto& o = m_options.forced;
	const Vector3d here = truth.T_map_body.translation();
	const Vector3d shift = o.distance * Vector3d(std::cos(o.direction), std::sin(o.direction), 0);
	Isometry3d jump = Isometry3d::Identity();
	jump.linear() = rotationFromYawPitchRoll(o.turn, 0, 0);
	jump.translation() = here + shift - jump.linear() * here;
	m_computer.forceCorrection(jump);
	m_forced = true;
}
}  // namespace posidonia
