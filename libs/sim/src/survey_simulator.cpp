#include <posidonia/base/error.h>
#include <posidonia/sim/survey_simulator.h>

#include <cmath>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Vector3d;
using mrpt::obs::CObservationStereoImages;

/** The rig as it is in the world, above its floor. */
struct CSurveySimulator::TRig
{
	TRig(const TSimulationOptions& o, const TStereoSpec& nominal)
		: errors(drawnSigns(o.calibration_error, o.run.seed)),
		  spec(trueStereo(nominal, errors)),
		  T_body_camera(spec.T_body_sensor()),
		  floor(o.floor, o.run.seed),
		  renderer(floor, o.floor.depth, spec.camera, o.water, o.camera),
		  seed(seedOf(o.run.seed, "pixel noise"))
	{
	}
	TCalibrationErrorOptions errors;
	TStereoSpec spec;
	Isometry3d T_body_camera;
	CFloorTexture floor;
	CFloorRenderer renderer;
	uint64_t seed;
};

CSurveySimulator::CSurveySimulator(const TSimulationOptions& options, const TSensorSuite& nominal)
	: m_options(options), m_nominal(nominal), m_motion(options.route, options.motion, options.run.seed)
{
	if (!options.run.stereo) m_nominal.stereo.clear();
	if (m_nominal.stereo.size() > 1)
		throw CError(
			"[Sensor.*]", "the simulator carries one stereo rig at most", "leave one entry of kind stereo");
	if (m_nominal.stereo.empty()) return;
	requireFloorUnderRoute();
	m_rig = std::make_unique<TRig>(m_options, m_nominal.stereo.begin()->second);
}
CSurveySimulator::~CSurveySimulator() = default;

void CSurveySimulator::requireFloorUnderRoute() const
{
	const TStereoSpec& rig = m_nominal.stereo.begin()->second;
	const double view = std::hypot(rig.camera.width, rig.camera.height) / 2 / rig.camera.fx;
	for (const auto& a : m_motion.plan().arrivals()) {
		const double height = m_options.floor.depth - a.position.z();
		const double margin = height * view + rig.T_body_sensor().translation().head<2>().norm();
		if (height <= 0)
			throw CError("[Route]", "a set point lies under the sea floor", "make [Floor] depth larger");
		if (std::abs(a.position.x()) + margin > m_options.floor.extent_north / 2 ||
			std::abs(a.position.y()) + margin > m_options.floor.extent_east / 2)
			throw CError(
				"[Route]",
				"the camera sees over the end of the floor's texture at north " +
					std::to_string(a.position.x()) + " east " + std::to_string(a.position.y()),
				"make [Floor] extent_north or extent_east larger");
	}
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
	CSensorBank bank(m_options, m_nominal);
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

TGreyPair CSurveySimulator::render(const TSimulatedObservation& pair) const
{
	const double exposure = pair.truth.t + m_rig->errors.camera_clock;
	const Isometry3d T_map_camera = m_motion.at(exposure).T_map_body * m_rig->T_body_camera;
	return renderPair(
		m_rig->renderer, T_map_camera, m_rig->spec.camera.baseline, m_rig->seed, pair.frame.value());
}

void CSurveySimulator::embedPictures(const TSimulatedObservation& pair) const
{
	auto& stereo = dynamic_cast<CObservationStereoImages&>(*pair.observation);
	const TGreyPair pictures = render(pair);
	stereo.imageLeft = mrpt::img::CImage(pictures.left, mrpt::img::DEEP_COPY);
	stereo.imageRight = mrpt::img::CImage(pictures.right, mrpt::img::DEEP_COPY);
}
}  // namespace posidonia
