#pragma once

#include <mrpt/system/CTimeLogger.h>
#include <posidonia/graphslam/loop_gate.h>
#include <posidonia/graphslam/slam_map.h>
#include <posidonia/nav/odometry_source.h>
#include <posidonia/obs/observations.h>
#include <posidonia/posegraph/incremental_optimizer.h>
#include <posidonia/vision/key_frame_extractor.h>
#include <posidonia/vision/stereo_registration.h>

#include <functional>
#include <memory>
#include <optional>

namespace posidonia
{
/** Options of everything inside the engine, a section each. */
struct TStereoSlamOptions
{
	TSlamOptions slam;
	TNodeOptions node;
	TSequentialOptions sequential;
	TRoiOptions roi;
	TGateOptions gate;
	TFeatureOptions features;
	TRegistrationOptions registration;
	TOptimizerOptions optimizer;
	TIncrementalOptions incremental;
	TGraphLossOptions loss;
	TPriorOptions priors;
	TLevMarqOptions levmarq;

	/** Online, each node brings a new graph: far below the noise is near enough (the next one starts from
	 * there). */
	TStereoSlamOptions()
	{
		optimizer.min_relative_decrease = 1e-5;
		optimizer.min_gradient = 0.02;
		// Stereo edges are good to millimetres over tens of metres.
		incremental.relinearize_step = 0.001;
		incremental.solve_tolerance = 1e-5;
	}

	/** Calls f("Section", its struct) for each. */
	template <class F>
	void forEachSection(F&& f)
	{
		f("Slam", slam);
		f("NodeRegistrationDeciderParameters", node);
		f("SequentialEdges", sequential);
		f("EdgeRegistrationDeciderParameters", roi);
		f("LoopGate", gate);
		f("Features", features);
		f("Registration", registration);
		f("GraphOptimizer", optimizer);
		f("GraphOptimizer", incremental);
		f("GraphOptimizer", loss);
		f("Priors", priors);
		f("OptimizerParameters", levmarq);
	}
};

/** How sure the graph is of one node seen from another. */
class CRelativeUncertainty
{
   public:
	virtual ~CRelativeUncertainty() = default;
	/** Covariances over (rho, phi) of T_i_j for one j and many i; nodes of the last optimisation. */
	virtual std::vector<Matrix6d> relativeCovariances(
		const CSlamMap& map, const std::vector<int>& is, int j) = 0;
};

/** Without marginals: covariances of the odometry edges from i to j composed along the chain, as if
 * independent. */
class CChainUncertainty : public CRelativeUncertainty
{
   public:
	std::vector<Matrix6d> relativeCovariances(
		const CSlamMap& map, const std::vector<int>& is, int j) override;
};

/** What the engine, its deciders and its optimiser share. The engine's owner makes it; it must outlive them.
 */
struct TSlamParts
{
	TSlamParts(
		const TStereoSlamOptions& options_, const TSensorSuite& sensors_, const COdometrySource& odometry_,
		const CStereoImageLoader& images_)
		: options(options_), sensors(sensors_), odometry(odometry_), images(images_), gate(options_.gate)
	{
	}

	const TStereoSlamOptions options;
	const TSensorSuite sensors;
	const COdometrySource& odometry;
	const CStereoImageLoader& images;
	const CLoopGate gate;
	CSlamMap map;
	CChainUncertainty chain_uncertainty;
	CRelativeUncertainty* uncertainty{
		&chain_uncertainty};				  ///< The optimiser puts itself here if it has marginals
	std::function<void()> make_exact{[] {}};  ///< Set by an optimiser whose poses are nearly exact
	mutable mrpt::system::CTimeLogger timer{true, "stages", true};
	TGreyPair last_pictures;  ///< Of the newest key frame; empty before the first

	/** The rig of a stereo observation's label, from the sensors.ini. Made at the first pair. */
	struct TRig
	{
		TStereoCamera camera;
		Eigen::Isometry3d T_body_camera;
		CKeyFrameExtractor extractor;
		CStereoRegistration registration;
	};
	/** Throws CError when a label has no entry, or the log's calibration contradicts the sensors.ini. */
	const TRig& rigOf(const mrpt::obs::CObservationStereoImages& pair);

	/** Reads the pair's pictures and makes node i's key frame, unless it has one. */
	const TKeyFrame& keyFrameOf(int i, const mrpt::obs::CObservationStereoImages& pair);

   private:
	std::optional<TRig> m_rig;
	std::string m_rig_label;
};

/** A decider or optimiser of this library: MRPT makes it without arguments, then it is given the parts. */
class CUsesSlamParts
{
   public:
	virtual ~CUsesSlamParts() = default;
	virtual void useParts(TSlamParts& parts) { m_parts = &parts; }

   protected:
	TSlamParts* m_parts{nullptr};
};
}  // namespace posidonia
