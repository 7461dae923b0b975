#include <posidonia/eval/data_lines.h>

#include <posidonia/base/error.h>
#include <posidonia/eval/loops_file.h>

#include <algorithm>
#include <array>

namespace posidonia
{
namespace
{
const std::string kWithoutWeight = "from,to,kind,status,matches,inliers,rmse_px,tx,ty,tz,qx,qy,qz,qw",
				  kHeader = kWithoutWeight + ",weight";
constexpr size_t kColumns = 15, kPose = 7, kWeight = 14;

std::uint64_t nodeId(const TDataLine& line, const std::string& cell)
{
	const long long id = line.whole(cell);
	if (id < 0) line.fail("the node id " + cell + " is negative", "correct the line");
	return static_cast<std::uint64_t>(id);
}

int countOrZero(const TDataLine& line, const std::string& cell)
{
	return cell.empty() ? 0 : static_cast<int>(line.whole(cell));
}

std::optional<Eigen::Isometry3d> poseOrNone(const TDataLine& line, const std::vector<std::string>& cells)
{
	if (std::all_of(cells.begin() + kPose, cells.begin() + kWeight, [](const auto& c) { return c.empty(); }))
		return {};
	std::array<double, 7> v;
	for (size_t i = 0; i < 7; i++)
		v[i] = line.real(cells[kPose + i]);
	Eigen::Isometry3d T_from_to = Eigen::Isometry3d::Identity();
	T_from_to.translation() << v[0], v[1], v[2];
	T_from_to.linear() = line.rotation(v[3], v[4], v[5], v[6]);
	return T_from_to;
}

TLoopRow loopRow(const TDataLine& line, bool with_weight)
{
	auto cells = line.cellsByComma();
	const size_t columns = with_weight ? kColumns : kWeight;
	if (cells.size() != columns)
		line.fail(
			std::to_string(cells.size()) + " columns, expected " + std::to_string(columns),
			"no text may hold a comma");
	cells.resize(kColumns);
	TLoopRow row;
	row.from = nodeId(line, cells[0]);
	row.to = nodeId(line, cells[1]);
	row.kind = cells[2];
	row.status = cells[3];
	row.matches = countOrZero(line, cells[4]);
	row.inliers = countOrZero(line, cells[5]);
	row.rmse = cells[6].empty() ? 0 : line.real(cells[6]);
	row.T_from_to = poseOrNone(line, cells);
	if (!cells[kWeight].empty()) row.weight = line.real(cells[kWeight]);
	if (row.accepted() && !row.T_from_to) line.fail("an accepted pair without its pose", "fill tx ... qw");
	return row;
}
}  // namespace

std::vector<TLoopRow> readLoops(const std::string& path)
{
	const auto lines = readDataLines(path);
	if (lines.empty()) throw CError(path, "is empty", "expected the header " + kHeader);
	const bool with_weight = lines[0].text == kHeader;
	if (!with_weight && lines[0].text != kWithoutWeight)
		lines[0].fail("is not the header of loops.csv", "expected " + kHeader);
	std::vector<TLoopRow> rows;
	for (size_t i = 1; i < lines.size(); i++)
		rows.push_back(loopRow(lines[i], with_weight));
	return rows;
}
}  // namespace posidonia
