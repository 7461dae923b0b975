#include <posidonia/sim/survey_simulator.h>

namespace posidonia
{
using Eigen::Vector3d;
using mrpt::obs::CObservationStereoImages;

CSurveySimulator::CSurveySimulator(const TSimulationOptions& options, const TSensorSuite& nominal)
	: m_options(options),
	  m_nominal(nominal),
	  m_motion(options.route, options.motion, options.run.seed),
	  m_scene(options, nominal)
{
	if (!options.run.stereo) m_nominal.stereo.clear();
	if (m_scene.hasCamera()) requireFloorUnderRoute();
}

void CSurveySimulator::requireFloorUnderRoute() const
{
	std::vector<Vector3d> positions;
	for (const auto& a : m_motion.plan().arrivals())
		positions.push_back(a.position);
	m_scene.requireFloorUnder(positions);
}

double CSurveySimulator::duration() const
{
	return m_options.run.duration > 0 ? m_options.run.duration : m_motion.plan().duration();
}

namespace
{
/** Which pairs save_images keeps: all, or the one nearest to each node_distance of 3D displacement. */
class CPairChooser
{
   public:
	explicit CPairChooser(const TRunOptions& o) : m_all(o.save_images == "all"), m_distance(o.node_distance)
	{
	}
	bool keeps(const Vector3d& position)
	{
		const double step = m_first ? 0 : (position - m_previous).norm();
		const double travelled = (position - m_kept).norm();
		const bool keep = m_all || m_first || travelled >= m_distance - step / 2;
		if (keep) m_kept = position;
		m_previous = position;
		m_first = false;
		return keep;
	}

   private:
	bool m_all, m_first{true};
	double m_distance;
	Vector3d m_kept{0, 0, 0}, m_previous{0, 0, 0};
};
}  // namespace

void CSurveySimulator::stream(const std::function<void(const TSimulatedObservation&)>& consume) const
{
	CSensorBank bank(m_options, m_nominal, m_scene.floor());
	CPairChooser chooser(m_options.run);
	uint64_t frame = 0;
	for (double t = bank.nextTime(); t <= duration(); t = bank.nextTime()) {
		TSimulatedObservation o;
		o.truth = m_motion.at(t);
		o.observation = bank.measure(o.truth);
		if (!o.observation) continue;
		if (IS_CLASS(*o.observation, CObservationStereoImages)) {
			o.frame = frame++;
			o.kept = chooser.keeps(o.truth.T_map_body.translation());
		}
		consume(o);
	}
}

TVehicleState CSurveySimulator::exposureOf(const TSimulatedObservation& pair) const
{
	return m_motion.at(pair.truth.t + m_scene.cameraClock());
}

TGreyPair CSurveySimulator::render(const TSimulatedObservation& pair) const
{
	const TVehicleState s = exposureOf(pair);
	return m_scene.photograph({s.T_map_body, s.v_body, s.omega_body}, pair.frame.value());
}

cv::Mat1f CSurveySimulator::depths(const TSimulatedObservation& pair) const
{
	return m_scene.depths(exposureOf(pair).T_map_body);
}

void CSurveySimulator::embedPictures(const TSimulatedObservation& pair) const
{
	auto& stereo = dynamic_cast<CObservationStereoImages&>(*pair.observation);
	const TGreyPair pictures = render(pair);
	stereo.imageLeft = mrpt::img::CImage(pictures.left, mrpt::img::DEEP_COPY);
	stereo.imageRight = mrpt::img::CImage(pictures.right, mrpt::img::DEEP_COPY);
}
}  // namespace posidonia
