#pragma once

#include <posidonia/nav/drag_model.h>
#include <posidonia/nav/nav_statistics.h>
#include <posidonia/nav/navigation_ekf.h>
#include <posidonia/nav/navigator_setup.h>
#include <posidonia/nav/pose_initializer.h>
#include <posidonia/nav/rest_detector.h>
#include <posidonia/nav/sensor_reading.h>

#include <memory>

namespace posidonia
{
/** The innovation of a measurement, before the gate: for tests of consistency. */
struct TInnovation
{
	int sensor{-1};
	double distance{0};	 ///< Squared Mahalanobis
	int degrees_of_freedom{0};
	bool fused{false};
};

/** Applies readings in order of their stamps to two filters: the navigation filter fuses everything, the edge
 * filter increments only (see README, "Edges"). Its memory can be saved and restored, so that history can be
 * replayed. */
class CNavigator
{
   public:
	explicit CNavigator(std::shared_ptr<const TNavigatorSetup> setup);

	/** `reading.stamp` must not lie before stamp(). A clone mark clones. */
	void apply(const TSensorReading& reading);
	/** Started, and, where the start is not known, settled on as many fixes as the options ask for. */
	bool ready() const { return m.ready; }
	double stamp() const { return m.stamp; }
	/** Continues at another stamp without moving: the clock was set. */
	void resetClock(double stamp);

	/** T_odom_body, T_clone_body, of the body's origin. */
	TPoseEstimate now() const;
	TPoseEstimate sinceClone() const;
	TUnaryMeasurements unary() const;
	/** Of the body's origin over ground, body axes [m/s]. */
	Eigen::Vector3d velocity() const;
	/** Without bias, body axes [rad/s]. */
	Eigen::Vector3d rate() const;

	const CNavigationEKF& navigationFilter() const { return m_nav; }
	CNavigationEKF& navigationFilter() { return m_nav; }
	const CNavigationEKF& edgeFilter() const { return m_edge; }
	const TSensorCount& count(int sensor) const { return m.sensors[static_cast<size_t>(sensor)].count; }
	double dragTime() const { return m.drag_time; }
	/** Of the last reading applied, if it was measured against the filter. */
	const TInnovation& lastInnovation() const { return m.innovation; }
	/** Leaves the edge filter alone: for runs without nodes, at half the cost. */
	void withoutEdges() { m_with_edges = false; }

   private:
	/** A sensor's refusals in a row that agree with each other. */
	struct TContradiction
	{
		int count{0};
		double since{0};  ///< Stamp of the first [s]
		CMeasurement::Value innovation{CMeasurement::Value::Zero()};
	};
	struct TSensorMemory
	{
		TSensorCount count;
		TContradiction contradiction;
	};
	/** A reading kept for unary(): with the pose it was taken at. */
	struct TKept
	{
		double stamp{-std::numeric_limits<double>::infinity()};
		Eigen::Isometry3d T_dr_body{Eigen::Isometry3d::Identity()};
		Eigen::Matrix3d R_map_body{Eigen::Matrix3d::Identity()};
	};
	struct TKeptDepth : TKept
	{
		TScalarMeasurement body_depth;
	};
	struct TKeptAttitude : TKept
	{
		TAttitudeMeasurement attitude;
	};
	struct TKeptFix : TKept
	{
		THorizontalMeasurement body_position;
	};
	/** Everything that changes, beside the filters. */
	struct TMemory
	{
		TMemory(const TNavigatorSetup& setup);
		bool started{false}, ready{false}, has_rate{false};
		int fixes{0};  ///< In a row since the start
		double fix_stamp{0};
		double stamp{std::numeric_limits<double>::quiet_NaN()};
		double imu_stamp{-std::numeric_limits<double>::infinity()};
		TInertialReading imu{{0, 0, 0}, {0, 0, 0}};
		double path{0}, path_at_clone{0};
		double clone_stamp{-std::numeric_limits<double>::infinity()};
		double previous_clone_stamp{-std::numeric_limits<double>::infinity()};
		Eigen::Isometry3d T_dr_clone{Eigen::Isometry3d::Identity()};  ///< Edges composed: dead reckoning
		std::vector<TSensorMemory> sensors;
		CPoseInitializer initializer;
		CDragModel drag;
		CRestDetector rest;
		double velocity_stamp{std::numeric_limits<double>::quiet_NaN()};  ///< Of the last DVL reading used
		Eigen::Vector3d unconfirmed{0, 0, 0};  ///< The first ping after a silence, instrument frame [m/s]
		double unconfirmed_stamp{-std::numeric_limits<double>::infinity()};
		double drag_stamp{0}, drag_time{0};
		bool dragging{false};
		TKeptDepth depth;
		TKeptAttitude attitude;
		TKeptFix fix;
		TInnovation innovation;
	};

   public:
	/** All that apply() changes. */
	class CSnapshot
	{
		friend class CNavigator;
		TMemory m;
		TFilterState nav, edge;
		explicit CSnapshot(const CNavigator& from);

	   public:
		double stamp() const { return m.stamp; }
	};
	CSnapshot snapshot() const { return CSnapshot(*this); }
	/** Overwrites `to` without allocating. */
	void save(CSnapshot& to) const;
	void restore(const CSnapshot& from);

   private:
	void apply(const TSensorReading& reading, const TTick&);
	void apply(const TSensorReading& reading, const TInertialReading& inertial);
	void apply(const TSensorReading& reading, const TAttitudeReading& attitude);
	void apply(const TSensorReading& reading, const TDvlReading& dvl);
	void apply(const TSensorReading& reading, const TDepthReading& depth);
	void apply(const TSensorReading& reading, const TFixReading& fix);
	void apply(const TSensorReading& reading, const TCloneMark&);

	/** Moves the present to t; between two readings of the IMU `imu` is their mean. */
	void predictTo(double t, const TInertialReading& imu);
	void predict(const TMotionInput& u);
	void startIfComplete();
	/** Counts a fix towards ready(); a gap that is too long starts anew (COLA2's rule). */
	void countFix();
	void becomeReady();
	void clone();
	/** Without bottom lock: a reading of the drag model each second. */
	void bridgeLossOfLock();
	void restIfStill(const TSensorReading& reading);
	TBodyRate bodyRate() const;
	CDvlMeasurement dvlMeasurement(const TNavigatorSetup::TSensor& sensor, const TDvlReading& dvl) const;
	/** After a silence the first ping is believed when the next one agrees: nothing else could tell a gross
	 * error then. */
	bool isConfirmed(const TDvlReading& dvl);
	bool beamsContradict(const TNavigatorSetup::TSensor& sensor, const TDvlReading& dvl) const;
	bool fuseAttitude(const TSensorReading& reading, const TAttitudeReading& attitude);
	/** Fuses and counts; an increments' sensor goes to the edge filter too. False: refused. */
	bool fuse(const CMeasurement& measurement, bool increments, int sensor);
	/** Has the sensor contradicted the filter steadily for too long? Called at each refusal. */
	bool isContradictedForTooLong(const CMeasurement& refused, TContradiction& contradiction);
	void keep(TKept& kept) const;
	Eigen::Isometry3d T_dr_body() const;
	bool isFresh(const TKept& kept) const;
	/** Variance that the present attitude's uncertainty gives R lever, each map axis [m^2]. */
	Eigen::Vector3d leverVariance(const Eigen::Vector3d& lever) const;
	double variance(int row) const;
	TSensorCount& countOf(const TSensorReading& reading)
	{
		return m.sensors[static_cast<size_t>(reading.sensor)].count;
	}
	const TNavigatorSetup::TSensor& specOf(const TSensorReading& reading) const
	{
		return m_setup->sensor[static_cast<size_t>(reading.sensor)];
	}
	void use(const TSensorReading& reading) { countOf(reading).use(m.stamp, specOf(reading).time_out); }

	std::shared_ptr<const TNavigatorSetup> m_setup;
	CNavigationEKF m_nav, m_edge;
	bool m_with_edges{true};
	TMemory m;
};
}  // namespace posidonia
