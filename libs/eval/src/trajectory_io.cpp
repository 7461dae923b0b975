#include <posidonia/eval/data_lines.h>

#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/eval/trajectory_io.h>
#include <posidonia/geometry/se3.h>

#include <array>
#include <cmath>

namespace posidonia
{
namespace
{
constexpr int kMetreDecimals = 9, kRotationDecimals = 12;
constexpr long long kNanoseconds = 1'000'000'000;

void requireFinite(const TStampedPose& pose, size_t i)
{
	if (std::isfinite(pose.stamp) && pose.T.matrix().allFinite()) return;
	throw CError("trajectory, pose " + std::to_string(i), "is not finite", "it can't be written");
}

/** (x, y, z, w) with w >= 0: one text a rotation. */
Eigen::Vector4d quaternion(const Eigen::Isometry3d& T)
{
	const Eigen::Vector4d q = Eigen::Quaterniond(T.linear()).normalized().coeffs();
	return q.w() < 0 ? Eigen::Vector4d(-q) : q;
}

std::string joined(const Eigen::VectorXd& values, int decimals, char separator)
{
	std::string text;
	for (double value : values)
		text += separator + fixedText(value, decimals);
	return text;
}

std::string matrixRows(const Eigen::Isometry3d& T)
{
	std::string text;
	for (int row = 0; row < 3; row++) {
		text += joined(T.linear().row(row).transpose(), kRotationDecimals, ' ');
		text += ' ' + fixedText(T.translation()[row], kMetreDecimals);
	}
	return text.substr(1);
}

[[noreturn]] void failColumns(const TDataLine& line, size_t found, const std::string& expected)
{
	line.fail(std::to_string(found) + " columns, expected " + expected, "correct or remove the line");
}

TStampedPose tumPose(const TDataLine& line)
{
	const auto cells = line.cellsByBlank();
	if (cells.size() != 8) failColumns(line, cells.size(), "8: t x y z qx qy qz qw");
	std::array<double, 8> v;
	for (size_t i = 0; i < 8; i++)
		v[i] = line.real(cells[i]);
	TStampedPose pose;
	pose.stamp = v[0];
	pose.T.translation() << v[1], v[2], v[3];
	pose.T.linear() = line.rotation(v[4], v[5], v[6], v[7]);
	return pose;
}

TStampedPose eurocPose(const TDataLine& line)
{
	const auto cells = line.cellsByComma();
	if (cells.size() < 8) failColumns(line, cells.size(), "at least 8: t,p_x,p_y,p_z,q_w,q_x,q_y,q_z");
	const long long ns = line.whole(cells[0]);
	std::array<double, 8> v;
	for (size_t i = 1; i < 8; i++)
		v[i] = line.real(cells[i]);
	TStampedPose pose;
	// Whole seconds apart: 19 digits do not fit a double, the split rounds once only.
	pose.stamp = static_cast<double>(ns / kNanoseconds) + static_cast<double>(ns % kNanoseconds) * 1e-9;
	pose.T.translation() << v[1], v[2], v[3];
	pose.T.linear() = line.rotation(v[5], v[6], v[7], v[4]);
	return pose;
}

TStampedPose kittiPose(const TDataLine& line)
{
	const auto cells = line.cellsByBlank();
	if (cells.size() != 12) failColumns(line, cells.size(), "12: the rows of [R t]");
	TStampedPose pose;
	for (int i = 0; i < 12; i++)
		pose.T.matrix()(i / 4, i % 4) = line.real(cells[static_cast<size_t>(i)]);
	const Eigen::Matrix3d R = pose.T.linear();
	if ((R * R.transpose() - Eigen::Matrix3d::Identity()).norm() > 0.01 || R.determinant() < 0)
		line.fail("the 3x3 part is not a rotation", "check the columns' order: rows of [R t]");
	pose.T = orthonormalized(pose.T);
	return pose;
}

void requireOrder(const TTrajectory& before, const TStampedPose& pose, const TDataLine& line)
{
	if (before.empty() || pose.stamp >= before.back().stamp) return;
	line.fail(
		"the stamp " + fixedText(pose.stamp, 9) + " s is before the previous one, " +
			fixedText(before.back().stamp, 9) + " s",
		"sort the poses by time");
}

template <class PARSE>
TTrajectory readPoses(const std::string& path, PARSE&& parse)
{
	TTrajectory trajectory;
	for (const auto& line : readDataLines(path)) {
		const TStampedPose pose = parse(line);
		requireOrder(trajectory, pose, line);
		trajectory.push_back(pose);
	}
	if (trajectory.empty()) throw CError(path, "holds no pose", "is it a trajectory?");
	return trajectory;
}

void writeText(const std::string& path, const std::string& text)
{
	writeFileWhole(path, [&](std::ostream& out) { out << text; });
}
}  // namespace

std::string tumText(const TTrajectory& trajectory)
{
	std::string text;
	for (size_t i = 0; i < trajectory.size(); i++) {
		const auto& pose = trajectory[i];
		requireFinite(pose, i);
		text += fixedText(pose.stamp, 9) + joined(pose.T.translation(), kMetreDecimals, ' ') +
				joined(quaternion(pose.T), kRotationDecimals, ' ') + '\n';
	}
	return text;
}

std::string kittiText(const TTrajectory& trajectory)
{
	std::string text;
	for (size_t i = 0; i < trajectory.size(); i++) {
		requireFinite(trajectory[i], i);
		text += matrixRows(trajectory[i].T) + '\n';
	}
	return text;
}

std::string eurocText(const TTrajectory& trajectory)
{
	std::string text = "#timestamp [ns],p_x [m],p_y [m],p_z [m],q_w,q_x,q_y,q_z\n";
	for (size_t i = 0; i < trajectory.size(); i++) {
		const auto& pose = trajectory[i];
		requireFinite(pose, i);
		const double seconds = std::floor(pose.stamp);
		const long long ns =
			std::llround((pose.stamp - seconds) * 1e9) + std::llround(seconds) * kNanoseconds;
		const Eigen::Vector4d q = quaternion(pose.T);
		text += std::to_string(ns) + joined(pose.T.translation(), kMetreDecimals, ',') +
				joined(Eigen::Vector4d(q.w(), q.x(), q.y(), q.z()), kRotationDecimals, ',') + '\n';
	}
	return text;
}

void writeTum(const std::string& path, const TTrajectory& trajectory)
{
	writeText(path, tumText(trajectory));
}
void writeKitti(const std::string& path, const TTrajectory& trajectory)
{
	writeText(path, kittiText(trajectory));
}
void writeEuroc(const std::string& path, const TTrajectory& trajectory)
{
	writeText(path, eurocText(trajectory));
}

TTrajectory readTum(const std::string& path)
{
	return readPoses(path, tumPose);
}
TTrajectory readEuroc(const std::string& path)
{
	return readPoses(path, eurocPose);
}

TTrajectory readKitti(const std::string& path)
{
	double index = 0;
	return readPoses(path, [&](const TDataLine& line) {
		TStampedPose pose = kittiPose(line);
		pose.stamp = index++;
		return pose;
	});
}

TTrajectory readKitti(const std::string& path, const std::string& stamps_path)
{
	TTrajectory trajectory = readKitti(path);
	const auto lines = readDataLines(stamps_path);
	if (lines.size() != trajectory.size())
		throw CError(
			stamps_path,
			std::to_string(lines.size()) + " stamps for the " + std::to_string(trajectory.size()) +
				" poses of " + path,
			"give one stamp a pose");
	TTrajectory before;
	for (size_t i = 0; i < lines.size(); i++) {
		trajectory[i].stamp = lines[i].real(lines[i].text);
		requireOrder(before, trajectory[i], lines[i]);
		before.assign(1, trajectory[i]);
	}
	return trajectory;
}

TTrajectory readTrajectory(const std::string& path)
{
	const auto lines = readDataLines(path);
	if (lines.empty()) throw CError(path, "holds no pose", "is it a trajectory?");
	if (lines[0].text.find(',') != std::string::npos) return readEuroc(path);
	return lines[0].cellsByBlank().size() == 12 ? readKitti(path) : readTum(path);
}
}  // namespace posidonia
