#pragma once

#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/association.h>
#include <random_pose.h>

#include <cstdio>
#include <string>

namespace posidonia::testing
{
/** A file of the running test's own, removed with it. */
class CTextFile
{
   public:
	explicit CTextFile(const std::string& text)
	{
		const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
		static int count = 0;
		m_path = ::testing::TempDir() + "posidonia_" + test->test_suite_name() + "_" + test->name() +
				 std::to_string(count++) + ".txt";
		writeFileWhole(m_path, [&](std::ostream& out) { out << text; });
	}
	~CTextFile() { std::remove(m_path.c_str()); }
	CTextFile(const CTextFile&) = delete;
	CTextFile& operator=(const CTextFile&) = delete;

	const std::string& path() const { return m_path; }

   private:
	std::string m_path;
};

/** The text of the CError that f throws; a failure when it throws none. */
template <class F>
std::string errorOf(F&& f)
{
	try {
		f();
	}
	catch (const CError& e) {
		return e.what();
	}
	ADD_FAILURE() << "no CError was thrown";
	return "";
}

inline void expectContains(const std::string& text, const std::string& part)
{
	EXPECT_NE(text.find(part), std::string::npos) << "'" << part << "' is not in '" << text << "'";
}

/** n poses of a smooth route, 0.5 s apart from `start`. */
inline TTrajectory smoothTrajectory(int n, double start)
{
	TTrajectory trajectory;
	for (int i = 0; i < n; i++) {
		const double s = 0.1 * i;
		Vector6d d;
		d << 5 * std::sin(s), 4 * std::cos(0.7 * s), 3.5 + 0.3 * std::sin(2 * s), 0.1 * std::sin(s),
			0.1 * std::cos(s), 2.5 * std::sin(0.3 * s);
		trajectory.push_back({start + 0.5 * i, retract(Eigen::Isometry3d::Identity(), d)});
	}
	return trajectory;
}

/** True poses and estimates of them: T_est_truth * truth, then noise. */
inline TAssociation noisyAssociation(
	std::mt19937& rng, int n, const Eigen::Isometry3d& T_est_truth, double metres, double radians)
{
	TAssociation poses;
	for (const auto& p : smoothTrajectory(n, 100))
		poses.push_back({p.stamp, poses.size(), p.T, T_est_truth * p.T * randomPose(rng, metres, radians)});
	return poses;
}
}  // namespace posidonia::testing
