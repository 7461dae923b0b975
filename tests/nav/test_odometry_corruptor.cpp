#include <gtest/gtest.h>
#include <mrpt/obs/CObservationStereoImages.h>
#include <posidonia/nav/odometry_corruptor.h>
#include <posidonia/obs/observations.h>

using namespace posidonia;
using Eigen::Isometry3d;
using Eigen::Vector3d;

namespace
{
/** A perfect source on a square way: 0.1 m a pair, 5 m legs, a quarter turn at each corner. */
class CSquareWay : public COdometrySource
{
   public:
	void add(const mrpt::obs::CObservation& o) override
	{
		m_stamp = stampOf(o);
		m_way += 0.1;
		if (++m_steps % 50 == 0) m_T.rotate(Eigen::AngleAxisd(M_PI / 2, Vector3d::UnitZ()));
		m_T.translate(Vector3d(0.1, 0, 0));
	}
	bool ready() const override { return true; }
	double stamp() const override { return m_stamp; }
	void clone() override { m_clone = m_T, m_way_at_clone = m_way; }
	TPoseEstimate sinceClone() const override
	{
		return {m_clone.inverse() * m_T, 1e-6 * Matrix6d::Identity(), m_way - m_way_at_clone};
	}
	TPoseEstimate now() const override { return {m_T, 1e-6 * Matrix6d::Identity(), m_way}; }
	TBodyMotion motion() const override { return {Vector3d(0.1, 0, 0), Vector3d::Zero()}; }

   private:
	Isometry3d m_T{Isometry3d::Identity()}, m_clone{Isometry3d::Identity()};
	double m_stamp{0}, m_way{0}, m_way_at_clone{0};
	int m_steps{0};
};

COdometryCorruptor corrupted(const TOdometryCorruptionOptions& options)
{
	return {std::make_unique<CSquareWay>(), options};
}

mrpt::obs::CObservationStereoImages::Ptr pair(int k)
{
	auto o = mrpt::obs::CObservationStereoImages::Create();
	o->timestamp = stampFrom(1e9 + k);
	return o;
}

TOdometryCorruptionOptions paperDrift()
{
	TOdometryCorruptionOptions o;
	o.drift_xy = 0.004;
	o.drift_z = 0.0013;
	return o;
}
/** The paper's way is 183.5 m. start() sees the first pair's pose: one more pair. */
constexpr int kPairs = 1836;
}  // namespace

TEST(OdometryCorruptor, WithoutDriftTheSourcePassesThroughExactly)
{
	COdometryCorruptor c = corrupted({});
	for (int k = 0; k < 300; k++) {
		c.add(*pair(k));
		if (k % 5 == 0) c.clone();
		EXPECT_EQ(c.now().T.matrix(), c.source().now().T.matrix()) << "k=" << k;
		EXPECT_EQ(c.now().cov, c.source().now().cov);
		EXPECT_EQ(c.sinceClone().T.matrix(), c.source().sinceClone().T.matrix()) << "k=" << k;
		EXPECT_EQ(c.sinceClone().cov, c.source().sinceClone().cov);
	}
	EXPECT_EQ(c.declaredDrift().sigma_xy, 0);
}

TEST(OdometryCorruptor, ErrorGrowsWithTheWayAsComputedByHand)
{
	TOdometryCorruptionOptions options = paperDrift();
	options.random_share = 0;
	COdometryCorruptor c = corrupted(options);
	double mean = 0;
	for (int k = 0; k < kPairs; k++) {
		c.add(*pair(k));
		mean += (c.now().T.translation() - c.source().now().T.translation()).norm() / kPairs;
	}
	const Vector3d error = c.now().T.translation() - c.source().now().T.translation();
	EXPECT_LT((error - 183.5 * Vector3d(0.004, 0.004, 0.0013)).norm(), 1e-9);
	EXPECT_NEAR(error.norm(), 1.065, 0.001);
	EXPECT_NEAR(mean, 0.533, 0.002);
	EXPECT_EQ(c.now().T.linear(), c.source().now().T.linear());
}

TEST(OdometryCorruptor, RandomPartIsSeededAndOfItsDeclaredSize)
{
	double square = 0;
	constexpr int kSeeds = 60;
	for (unsigned seed = 1; seed <= kSeeds; seed++) {
		TOdometryCorruptionOptions options = paperDrift();
		options.seed = seed;
		COdometryCorruptor a = corrupted(options), b = corrupted(options);
		for (int k = 0; k < kPairs; k++)
			a.add(*pair(k)), b.add(*pair(k));
		EXPECT_EQ(a.now().T.matrix(), b.now().T.matrix()) << "seed=" << seed;
		const Vector3d random = a.now().T.translation() - a.source().now().T.translation() -
								183.5 * Vector3d(0.004, 0.004, 0.0013);
		square += random.head<2>().squaredNorm() / (2 * kSeeds);
	}
	const double expected = 0.25 * 0.004 * std::sqrt(183.5);  // 13.5 mm an axis
	EXPECT_NEAR(std::sqrt(square), expected, 0.2 * expected);
}

TEST(OdometryCorruptor, EdgesComposeToTheCorruptedTrajectory)
{
	COdometryCorruptor c = corrupted(paperDrift());
	c.add(*pair(0));
	c.clone();
	Isometry3d composed = c.now().T;
	for (int k = 1; k < 600; k++) {
		c.add(*pair(k));
		if (k % 5 != 0) continue;
		composed = composed * c.sinceClone().T;
		c.clone();
		EXPECT_LT((c.sinceClone().T.matrix() - Eigen::Matrix4d::Identity()).norm(), 1e-12) << "k=" << k;
		EXPECT_LT((composed.matrix() - c.now().T.matrix()).norm(), 1e-9) << "k=" << k;
	}
	EXPECT_GT((composed.translation() - c.source().now().T.translation()).norm(), 0.3);
}

TEST(OdometryCorruptor, EdgesDeclareTheirSigmaAlongMapAxesInTheirOwnFrame)
{
	TOdometryCorruptionOptions options = paperDrift();
	options.declared_sigma_z = 0.02;
	COdometryCorruptor c = corrupted(options);
	EXPECT_DOUBLE_EQ(c.declaredDrift().sigma_xy, 2.5 * 0.004);
	EXPECT_DOUBLE_EQ(c.declaredDrift().sigma_z, 0.02);
	for (int k = 0; k < 10; k++)
		c.add(*pair(k));
	c.clone();
	for (int k = 10; k < 60; k++)
		c.add(*pair(k));  // 5 m, with a quarter turn
	const Matrix6d added = c.sinceClone().cov - c.source().sinceClone().cov;
	EXPECT_NEAR(added(0, 0), std::pow(5 * 0.01, 2), 1e-9);
	EXPECT_NEAR(added(1, 1), std::pow(5 * 0.01, 2), 1e-9);
	EXPECT_NEAR(added(2, 2), std::pow(5 * 0.02, 2), 1e-9);
	EXPECT_EQ(added.bottomRows<3>().norm(), 0);
}

TEST(OdometryCorruptor, ZeroDeclaredIsTheNaiveFilter)
{
	TOdometryCorruptionOptions options = paperDrift();
	options.declared_sigma_xy = options.declared_sigma_z = 0;
	COdometryCorruptor c = corrupted(options);
	c.clone();
	for (int k = 0; k < 60; k++)
		c.add(*pair(k));
	EXPECT_EQ(c.sinceClone().cov, c.source().sinceClone().cov);
	EXPECT_GT((c.sinceClone().T.translation() - c.source().sinceClone().T.translation()).norm(), 0.01);
}
