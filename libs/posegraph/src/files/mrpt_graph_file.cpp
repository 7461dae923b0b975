#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/geometry/mrpt_pose.h>
#include <posidonia/posegraph/mrpt_graph_file.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string_view>

namespace posidonia
{
namespace
{
constexpr int kInformationNumbers = 21;

/** A line of the file, cut into words. */
struct TLine
{
	std::string where;
	std::vector<std::string_view> words;

	/** A node's annotation may follow: " | text". */
	TLine(const std::string& path, int number, std::string_view text)
		: where(path + ":" + std::to_string(number))
	{
		text = text.substr(0, text.find('|'));
		const auto blank = [](char c) { return c == ' ' || c == '\t' || c == '\r'; };
		for (auto at = text.begin(); (at = std::find_if_not(at, text.end(), blank)) != text.end();) {
			const auto end = std::find_if(at, text.end(), blank);
			words.push_back(text.substr(size_t(at - text.begin()), size_t(end - at)));
			at = end;
		}
	}

	/** As MRPT: in any case. */
	std::string tag() const
	{
		std::string upper(words[0]);
		std::transform(upper.begin(), upper.end(), upper.begin(), [](unsigned char c) {
			return static_cast<char>(std::toupper(c));
		});
		return upper;
	}

	template <class NUMBER>
	NUMBER number(size_t i) const
	{
		const std::string_view text = words[i];
		NUMBER value{};
		const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
		if (error != std::errc() || end != text.data() + text.size())
			fail("'" + std::string(text) + "' is not a number of the kind expected here");
		return value;
	}

	/** x y z roll pitch yaw from word i on. */
	Eigen::Isometry3d pose(size_t i) const
	{
		Vector6d v;
		for (size_t k = 0; k < 6; k++)
			v[Eigen::Index(k)] = number<double>(i + k);
		if (!v.allFinite()) fail("the pose is not finite");
		Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
		T.linear() = rotationFromYawPitchRoll(v[5], v[4], v[3]);
		T.translation() = v.head<3>();
		return T;
	}

	/** Upper triangle over (x, y, z, roll, pitch, yaw) from word i on, told in MRPT's order (.., yaw, pitch,
	 * roll). */
	Matrix6d information(size_t i) const
	{
		constexpr int kMrptIndex[] = {0, 1, 2, 5, 4, 3};
		Matrix6d M;
		for (int r = 0; r < 6; r++)
			for (int c = r; c < 6; c++)
				M(kMrptIndex[r], kMrptIndex[c]) = M(kMrptIndex[c], kMrptIndex[r]) = number<double>(i++);
		return M;
	}

	void requireWords(size_t count) const
	{
		if (words.size() < count) fail("the line ends too early");
		if (words.size() > count)
			fail("'" + std::string(words[count]) + "' is more than belongs on this line");
	}

	[[noreturn]] void fail(const std::string& problem) const
	{
		throw CError(
			where, problem,
			"expected VERTEX3 id x y z roll pitch yaw, EDGE3 from to x y z roll pitch yaw and 21 numbers of "
			"information, FIX id, or EQUIV id id");
	}
};

/** From MRPT's coordinates to ours, at the edge's pose. */
Matrix6d localInformationOf(const Eigen::Isometry3d& T, const Matrix6d& mrpt)
{
	const Matrix6d J = mrptFromLocalJacobian(T);
	const Matrix6d local = J.transpose() * mrpt * J;
	return 0.5 * (local + local.transpose());
}

class CMrptGraphReader
{
   public:
	explicit CMrptGraphReader(const std::string& path) : m_path(path) {}

	TMrptGraphFile read()
	{
		const std::string text = readFileText(m_path);
		int number = 0;
		for (size_t start = 0; start < text.size();) {
			const size_t end = std::min(text.find('\n', start), text.size());
			const TLine line(m_path, ++number, std::string_view(text).substr(start, end - start));
			if (!line.words.empty() && line.words[0][0] != '#') readLine(line);
			start = end + 1;
		}
		return build();
	}

   private:
	struct TFileEdge
	{
		std::string where;
		long long from, to;
		TPoseEdge edge;
	};

	void readLine(const TLine& line)
	{
		const std::string tag = line.tag();
		if (tag == "VERTEX3")
			readVertex(line);
		else if (tag == "EDGE3")
			readEdge(line);
		else if (tag == "FIX")
			readFix(line);
		else if (tag == "EQUIV")
			readEquivalence(line);
		else if (tag.find("QUAT") != std::string::npos)
			line.fail("a g2o line; name the file .g2o");
		else
			line.fail("unknown tag '" + tag + "' (2D graphs are not read)");
	}

	void readVertex(const TLine& line)
	{
		line.requireWords(8);
		const auto id = line.number<long long>(1);
		if (!m_poses.emplace(id, line.pose(2)).second)
			line.fail("vertex " + std::to_string(id) + " is there twice");
	}

	void readEdge(const TLine& line)
	{
		const bool has_information = line.words.size() != 9;
		line.requireWords(has_information ? 9 + kInformationNumbers : 9);
		TFileEdge out{line.where, line.number<long long>(1), line.number<long long>(2), {}};
		out.edge.T_from_to = line.pose(3);
		const Matrix6d information = has_information ? line.information(9) : Matrix6d::Identity();
		if (std::abs(std::cos(yawPitchRoll(out.edge.T_from_to.linear())[1])) < 1e-6)
			line.fail("at 90 deg of pitch the information over roll, pitch and yaw says nothing");
		out.edge.information = localInformationOf(out.edge.T_from_to, information);
		m_without_information += has_information ? 0 : 1;
		m_edges.push_back(out);
	}

	void readFix(const TLine& line)
	{
		line.requireWords(2);
		if (!m_fix_where.empty()) line.fail("a second FIX; the format has one root");
		m_fix_where = line.where;
		m_fixed = line.number<long long>(1);
	}

	void readEquivalence(const TLine& line)
	{
		line.requireWords(3);
		const auto a = line.number<long long>(1), b = line.number<long long>(2);
		m_same[std::max(a, b)] = std::min(a, b);
	}

	/** The id that a node goes by. */
	long long idOf(long long id) const
	{
		for (auto same = m_same.find(id); same != m_same.end() && same->second != id; same = m_same.find(id))
			id = same->second;
		return id;
	}

	TMrptGraphFile build()
	{
		if (m_poses.empty()) throw CError(m_path, "no VERTEX3 line", "is it a 3D pose graph of MRPT?");
		if (m_fix_where.empty()) m_fixed = m_poses.begin()->first;
		requireVertex(idOf(m_fixed), m_fix_where);
		TMrptGraphFile out;
		for (const auto& [id, pose] : m_poses) {
			if (idOf(id) != id) continue;
			m_node_of_id[id] = out.graph.addNode(pose, id == idOf(m_fixed));
			out.file_ids.push_back(id);
		}
		for (const TFileEdge& edge : m_edges)
			addEdge(edge, out.graph);
		out.edges_without_information = m_without_information;
		return out;
	}

	void requireVertex(long long id, const std::string& where) const
	{
		if (m_poses.count(id)) return;
		throw CError(where, "there is no vertex " + std::to_string(id), "add its VERTEX3 line");
	}

	void addEdge(const TFileEdge& in, CPoseGraph& graph) const
	{
		const long long from = idOf(in.from), to = idOf(in.to);
		requireVertex(from, in.where);
		requireVertex(to, in.where);
		if (from == to && in.from != in.to) return;	 // EQUIV made one node of its ends
		TPoseEdge edge = in.edge;
		edge.from = m_node_of_id.at(from);
		edge.to = m_node_of_id.at(to);
		try {
			graph.addEdge(edge);
		}
		catch (const CError& error) {
			throw CError(in.where, error.what(), "");
		}
	}

	std::string m_path, m_fix_where;
	long long m_fixed{0};
	std::map<long long, Eigen::Isometry3d> m_poses;
	std::map<long long, long long> m_same;	// the higher of two ids of one node, to the lower
	std::map<long long, int> m_node_of_id;
	std::vector<TFileEdge> m_edges;
	int m_without_information{0};
};
}  // namespace

TMrptGraphFile readMrptGraph(const std::string& path)
{
	return CMrptGraphReader(path).read();
}
}  // namespace posidonia
