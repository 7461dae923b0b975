#include <posidonia/report/run_files.h>

#include "csv_lines.h"

namespace posidonia
{
namespace
{
/** Names of the upper triangle of a covariance over north, east, down, and rotations about them. */
std::string covarianceHeader()
{
	const std::string axes[] = {"n", "e", "d", "rn", "re", "rd"};
	std::string text;
	for (int i = 0; i < 6; i++)
		for (int j = i; j < 6; j++)
			text += ",c_" + axes[i] + "_" + axes[j];
	return text;
}
const std::string kNodesHeader =
	"node,stamp,north,east,down,qx,qy,qz,qw,roll_deg,pitch_deg,yaw_deg,points,altitude,picture" +
	covarianceHeader();
constexpr size_t kFirstCovariance = 15, kNodeCells = kFirstCovariance + 21;
}  // namespace

Matrix6d covarianceInMap(const Eigen::Isometry3d& T_map_body, const Matrix6d& covariance)
{
	Matrix6d turn = Matrix6d::Zero();
	turn.topLeftCorner<3, 3>() = turn.bottomRightCorner<3, 3>() = T_map_body.linear();
	return turn * covariance * turn.transpose();
}

std::string nodesCsv(const std::vector<TNodeRow>& rows)
{
	std::string csv = kNodesHeader + "\n";
	for (const TNodeRow& row : rows) {
		csv += std::to_string(row.node) + numberText(row.stamp, ",%.9f");
		for (const double v : row.T_map_body.translation())
			csv += numberText(v, ",%.9f");
		Eigen::Quaterniond q(row.T_map_body.linear());
		if (q.w() < 0) q.coeffs() = -q.coeffs();
		for (const double v : q.coeffs())
			csv += numberText(v, ",%.12f");
		const Eigen::Vector3d ypr = yawPitchRoll(row.T_map_body.linear()) * (180 / M_PI);
		csv += numberText(ypr[2], ",%.6f") + numberText(ypr[1], ",%.6f") + numberText(ypr[0], ",%.6f");
		csv += "," + std::to_string(row.points) + numberText(row.altitude, ",%.4f") + "," + row.picture;
		for (int i = 0; i < 6; i++)
			for (int j = i; j < 6; j++)
				csv += numberText(row.covariance(i, j), ",%.9g");
		csv += "\n";
	}
	return csv;
}

std::vector<TNodeRow> readNodes(const std::string& path)
{
	std::vector<TNodeRow> rows;
	for (const TDataLine& line : linesUnder(kNodesHeader, path)) {
		const auto cells = cellsOf(line, kNodeCells);
		TNodeRow row;
		row.node = static_cast<int>(line.whole(cells[0]));
		row.stamp = line.real(cells[1]);
		for (size_t i = 0; i < 3; i++)
			row.T_map_body.translation()[static_cast<int>(i)] = line.real(cells[2 + i]);
		row.T_map_body.linear() =
			line.rotation(line.real(cells[5]), line.real(cells[6]), line.real(cells[7]), line.real(cells[8]));
		row.points = static_cast<int>(line.whole(cells[12]));
		row.altitude = line.real(cells[13]);
		row.picture = cells[14];
		size_t next = kFirstCovariance;
		for (int i = 0; i < 6; i++)
			for (int j = i; j < 6; j++)
				row.covariance(i, j) = row.covariance(j, i) = line.real(cells[next++]);
		rows.push_back(row);
	}
	return rows;
}
}  // namespace posidonia
