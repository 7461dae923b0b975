#pragma once

#include <posidonia/base/options.h>
#include <posidonia/nav/odometry_source.h>

#include <deque>
#include <limits>
#include <memory>
#include <random>

namespace posidonia
{
/** Section [OdometryCorruption]: the paper's experiments. All zero: the decorated source passes through
 * exactly. */
struct TOdometryCorruptionOptions
{
	double drift_xy{0};
	double drift_z{0};
	double random_share{0.25};
	unsigned seed{1};
	double declared_factor{2.5};
	double declared_sigma_xy{-1};
	double declared_sigma_z{-1};

	double declaredXY() const
	{
		return declared_sigma_xy < 0 ? declared_factor * drift_xy : declared_sigma_xy;
	}
	double declaredZ() const { return declared_sigma_z < 0 ? declared_factor * drift_z : declared_sigma_z; }

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.number(
			"drift_xy", drift_xy, atLeast(0), "Bias along north and along east [m/m] (paper: 0.004, 0.012)");
		v.number("drift_z", drift_z, atLeast(0), "Bias along down [m/m] (paper: 0.0013, 0.004)");
		v.number(
			"random_share", random_share, atLeast(0), "Random part: this share of the drift [1/sqrt(m)]");
		v.seed("seed", seed, "Of the random part");
		v.number(
			"declared_factor", declared_factor, atLeast(0),
			"Declared sigma = this times the drift, where none is given below");
		v.number(
			"declared_sigma_xy", declared_sigma_xy, anyNumber(),
			"Sigma that the edges declare, north and east [m/m]; negative: declared_factor * drift_xy; 0: "
			"naive");
		v.number(
			"declared_sigma_z", declared_sigma_z, anyNumber(),
			"Sigma that the edges declare, down [m/m]; negative: declared_factor * drift_z; 0: naive");
	}
};

/** Adds the paper's drift to any odometry source: a constant bias in map axes per travelled metre plus a
 * random part. Positions only; the attitude is not touched. The travelled metres are the distances between
 * the decorated source's poses at consecutive stereo pairs; between pairs the bias of the way since the last
 * one is added. */
class COdometryCorruptor : public COdometrySource
{
   public:
	COdometryCorruptor(std::unique_ptr<COdometrySource> source, const TOdometryCorruptionOptions& options);

	void add(const mrpt::obs::CObservation& observation) override;
	bool ready() const override { return m_source->ready(); }
	double stamp() const override { return m_source->stamp(); }
	void clone() override;
	/** The offset gained since the clone, turned from map axes into the clone's frame, is added to the
	 * source's edge; its covariance gains the declared sigma times the edge's way, squared. */
	TPoseEstimate sinceClone() const override;
	TPoseEstimate now() const override;
	/** The source's: the drift is far slower than a controller's noise. */
	TBodyMotion motion() const override { return m_source->motion(); }
	TDeclaredDrift declaredDrift() const override;
	TUnaryMeasurements unary() const override { return m_source->unary(); }

	/** The source's, with the drift that the edges had when they were handed out. */
	std::vector<TRevisedEdge> takeRevisedEdges() override;

	const COdometrySource& source() const { return *m_source; }

   private:
	bool isActive() const { return m_options.drift_xy > 0 || m_options.drift_z > 0; }
	void start();
	Eigen::Vector3d driftPerMetre() const
	{
		return {m_options.drift_xy, m_options.drift_xy, m_options.drift_z};
	}
	/** What is added to the present position, map axes [m]. */
	Eigen::Vector3d offset() const;
	Eigen::Vector3d randomStep(double way);
	/** The declared covariance of `way` metres in the frame of R_map_body. */
	Matrix6d declaredCovariance(double way, const Eigen::Matrix3d& R_map_body) const;

	std::unique_ptr<COdometrySource> m_source;
	TOdometryCorruptionOptions m_options;
	std::mt19937 m_rng;
	bool m_started{false};
	Eigen::Vector3d m_last_position{0, 0, 0};  ///< Of the source at the last stereo pair
	Eigen::Vector3d m_offset{0, 0, 0};		   ///< At the last stereo pair
	Eigen::Vector3d m_offset_at_clone{0, 0, 0};
	Eigen::Matrix3d m_R_map_clone{Eigen::Matrix3d::Identity()};
	/** What the drift did to the edge that ended at a clone. */
	struct TEdgeDrift
	{
		size_t clone;
		Eigen::Matrix3d R_map_from;
		Eigen::Vector3d drift;	 ///< Map axes [m]
		Eigen::Vector3d offset;	 ///< At its end, map axes [m]
	};
	std::deque<TEdgeDrift> m_drifts;  ///< Of the last edges
	size_t m_clones{0};
	TPoseEstimate corrupted(
		TPoseEstimate edge, const Eigen::Matrix3d& R_map_from, const Eigen::Vector3d& drift) const;
};
}  // namespace posidonia
