#pragma once

#include <mrpt/obs/CObservation.h>
#include <posidonia/geometry/se3.h>

#include <optional>
#include <vector>

namespace posidonia
{
/** A pose with the covariance of its own-frame perturbation (rho, phi) and the way travelled. */
struct TPoseEstimate
{
	Eigen::Isometry3d T{Eigen::Isometry3d::Identity()};
	Matrix6d cov{Matrix6d::Zero()};	 ///< Over (rho, phi), see geometry/se3.h [m^2, m rad, rad^2]
	double path_length{0};			 ///< Way travelled [m]: since the clone, or since ready() for now()
};

/** Error per travelled metre that the source says of itself and that does NOT average out over edges (a
 * scale, a mounting angle, a heading offset): constant in map axes, so it grows with the way and not with its
 * root. */
struct TDeclaredDrift
{
	double sigma_xy{0}, sigma_z{0};	 ///< [m/m], north and east each; down
};

/** Attitude as measured: R_measured = Exp(e) R_true, e in map axes. */
struct TAttitudeMeasurement
{
	Eigen::Matrix3d R_map_body{Eigen::Matrix3d::Identity()};
	double sigma_roll_pitch{0};	 ///< e about north and about east [rad]
	double sigma_heading{0};	 ///< e about down [rad]
	/** Parts of these sigmas that do not change from reading to reading, and their correlation time [s]. */
	double lasting_roll_pitch{0}, lasting_heading{0}, lasting_time{0};
};
/** A single number with its standard deviation. */
struct TScalarMeasurement
{
	double value{0}, sigma{0};
	double lasting{0}, lasting_time{0};	 ///< As in TAttitudeMeasurement
};
/** North and east of the body's origin. */
struct THorizontalMeasurement
{
	Eigen::Vector2d value{0, 0};		 ///< [m]
	double sigma{0};					 ///< Each axis [m]
	double lasting{0}, lasting_time{0};	 ///< As in TAttitudeMeasurement
};

/** What was measured absolutely at the present stamp: each the newest reading since the previous node, moved
 * to the body's origin and to the present by dead reckoning; empty when there was none. Independent of
 * now()'s smoothing and of the edges' noise (except the reading's own), so a graph may use them as priors of
 * the node. */
struct TUnaryMeasurements
{
	std::optional<TScalarMeasurement> depth;  ///< Down of the body's origin in map [m]
	std::optional<TAttitudeMeasurement> attitude;
	std::optional<THorizontalMeasurement> position;	 ///< From GPS
};

/** How the body moves over ground, in body axes. */
struct TBodyMotion
{
	Eigen::Vector3d velocity{0, 0, 0};	///< [m/s]
	Eigen::Vector3d rate{0, 0, 0};		///< [rad/s]
};

/** An edge that late observations changed after it was handed out. */
struct TRevisedEdge
{
	size_t clone{0};  ///< It ended at this call of clone(), counted from 0
	TPoseEstimate edge;
	Eigen::Isometry3d T_odom_body{Eigen::Isometry3d::Identity()};  ///< At that clone, as it is known now
};

/** Where the engine's odometry comes from. Fed with EVERY observation in order of arrival (stereo pairs too:
 * they only move the present to their stamp). Deterministic: the same observations give the same bytes. */
class COdometrySource
{
   public:
	virtual ~COdometrySource() = default;

	/** Throws CError for a sensor label without an entry. */
	virtual void add(const mrpt::obs::CObservation& observation) = 0;
	/** May the pose be used? Before that, only add(), ready() and stamp() may be called. */
	virtual bool ready() const = 0;
	/** Stamp of the present [UTC s]: that of the newest observation used, NaN before the first. */
	virtual double stamp() const = 0;

	/** Puts the clone at the present pose; called when a node is made at the present stamp. */
	virtual void clone() = 0;
	/** T_clone_body with the covariance of this displacement itself, made of increments only; since ready()
	 * where clone() has not been called. */
	virtual TPoseEstimate sinceClone() const = 0;
	/** T_odom_body; the covariance may use absolute measurements. */
	virtual TPoseEstimate now() const = 0;
	/** At the present, for controllers. */
	virtual TBodyMotion motion() const = 0;
	virtual TDeclaredDrift declaredDrift() const { return {}; }
	virtual TUnaryMeasurements unary() const { return {}; }
	/** Edges, handed out before, that late observations have changed since the last call. */
	virtual std::vector<TRevisedEdge> takeRevisedEdges() { return {}; }
};
}  // namespace posidonia
