#include <posidonia/base/error.h>
#include <posidonia/base/files.h>
#include <posidonia/posegraph/g2o_file.h>

#include <array>
#include <charconv>
#include <cmath>
#include <iomanip>
#include <map>
#include <numeric>
#include <set>
#include <string_view>

namespace posidonia
{
namespace
{
/** d(t, 2 vec q) / d(t, vec q) = diag(1, 1, 1, 2, 2, 2): e_ours = S e_g2o, so Omega_g2o = S Omega S. Powers
 * of two: exact both ways. */
double scaleOf(int i)
{
	return i < 3 ? 1 : 2;
}

Matrix6d informationFromG2o(Matrix6d g2o)
{
	for (int i = 0; i < 6; i++)
		for (int j = 0; j < 6; j++)
			g2o(i, j) /= scaleOf(i) * scaleOf(j);
	return g2o;
}

Matrix6d informationToG2o(Matrix6d information)
{
	for (int i = 0; i < 6; i++)
		for (int j = 0; j < 6; j++)
			information(i, j) *= scaleOf(i) * scaleOf(j);
	return information;
}

/** One line's blank-separated words, read one after the other. */
class CLineReader
{
   public:
	CLineReader(std::string where, std::string_view line) : m_where(std::move(where)), m_rest(line) {}

	bool atEnd()
	{
		const size_t first = m_rest.find_first_not_of(" \t\r");
		m_rest.remove_prefix(std::min(first, m_rest.size()));
		return m_rest.empty();
	}

	std::string_view word()
	{
		if (atEnd()) fail("the line ends too early");
		const std::string_view found = m_rest.substr(0, m_rest.find_first_of(" \t\r"));
		m_rest.remove_prefix(found.size());
		return found;
	}

	template <class NUMBER>
	NUMBER number()
	{
		const std::string_view text = word();
		NUMBER value{};
		const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
		if (error != std::errc() || end != text.data() + text.size())
			fail("'" + std::string(text) + "' is not a number of the kind expected here");
		return value;
	}

	/** x y z qx qy qz qw */
	Eigen::Isometry3d pose()
	{
		std::array<double, 7> v;
		for (double& x : v)
			x = number<double>();
		const Eigen::Quaterniond q(v[6], v[3], v[4], v[5]);
		// Written with few digits at worst; anything else is no rotation.
		if (!(std::abs(q.norm() - 1) < 1e-2)) fail("the quaternion (qx qy qz qw) is not of unit length");
		Eigen::Isometry3d T = Eigen::Isometry3d::Identity();
		T.linear() = q.normalized().toRotationMatrix();
		T.translation() << v[0], v[1], v[2];
		if (!T.matrix().allFinite()) fail("the pose is not finite");
		return T;
	}

	/** 21 numbers: the upper triangle, row by row. */
	Matrix6d symmetric()
	{
		Matrix6d M;
		for (int i = 0; i < 6; i++)
			for (int j = i; j < 6; j++)
				M(i, j) = M(j, i) = number<double>();
		return M;
	}

	void requireEnd()
	{
		if (!atEnd()) fail("'" + std::string(word()) + "' is more than belongs on this line");
	}

	[[noreturn]] void fail(const std::string& problem) const
	{
		throw CError(
			m_where, problem,
			"expected VERTEX_SE3:QUAT id x y z qx qy qz qw, EDGE_SE3:QUAT from to x y z qx qy qz "
			"qw and 21 numbers of information, or FIX id ...");
	}

   private:
	std::string m_where;
	std::string_view m_rest;
};

class CG2oReader
{
   public:
	explicit CG2oReader(const std::string& path) : m_path(path) {}

	TG2oGraph read()
	{
		const std::string text = readFileText(m_path);
		for (size_t start = 0; start < text.size();) {
			m_line++;
			const size_t end = std::min(text.find('\n', start), text.size());
			readLine(std::string_view(text).substr(start, end - start));
			start = end + 1;
		}
		return build();
	}

   private:
	struct TFileEdge
	{
		int line;
		long long from, to;
		TPoseEdge edge;
	};

	std::string where(int line) const { return m_path + ":" + std::to_string(line); }

	void readLine(std::string_view text)
	{
		CLineReader line(where(m_line), text);
		if (line.atEnd()) return;
		const std::string_view tag = line.word();
		if (tag[0] == '#') return;
		if (tag == "VERTEX_SE3:QUAT")
			readVertex(line);
		else if (tag == "EDGE_SE3:QUAT")
			readEdge(line);
		else if (tag == "FIX")
			readFix(line);
		else
			line.fail("unknown tag '" + std::string(tag) + "'");
		line.requireEnd();
	}

	void readVertex(CLineReader& line)
	{
		const auto id = line.number<long long>();
		if (!m_poses.emplace(id, line.pose()).second)
			line.fail("vertex " + std::to_string(id) + " is there twice");
	}

	void readEdge(CLineReader& line)
	{
		TFileEdge out{m_line, line.number<long long>(), line.number<long long>(), {}};
		out.edge.T_from_to = line.pose();
		out.edge.information = informationFromG2o(line.symmetric());
		m_edges.push_back(out);
	}

	void readFix(CLineReader& line)
	{
		do
			m_fixed.emplace(line.number<long long>(), m_line);
		while (!line.atEnd());
	}

	TG2oGraph build()
	{
		if (m_poses.empty()) throw CError(m_path, "no VERTEX_SE3:QUAT line", "is it a 3D g2o pose graph?");
		for (const auto& [id, line] : m_fixed)
			requireVertex(id, line);
		if (m_fixed.empty()) m_fixed.emplace(m_poses.begin()->first, 0);
		TG2oGraph out;
		for (const auto& [id, pose] : m_poses) {
			out.graph.addNode(pose, m_fixed.count(id) > 0);
			out.file_ids.push_back(id);
		}
		int next = 0;
		for (const auto& item : m_poses)
			m_node_of_id[item.first] = next++;
		for (const TFileEdge& edge : m_edges)
			addEdge(edge, out.graph);
		return out;
	}

	void requireVertex(long long id, int line) const
	{
		if (m_poses.count(id)) return;
		throw CError(where(line), "there is no vertex " + std::to_string(id), "add its VERTEX_SE3:QUAT line");
	}

	void addEdge(const TFileEdge& in, CPoseGraph& graph) const
	{
		requireVertex(in.from, in.line);
		requireVertex(in.to, in.line);
		TPoseEdge edge = in.edge;
		edge.from = m_node_of_id.at(in.from);
		edge.to = m_node_of_id.at(in.to);
		try {
			graph.addEdge(edge);
		}
		catch (const CError& error) {
			throw CError(where(in.line), error.what(), "");
		}
	}

	std::string m_path;
	int m_line{0};
	std::map<long long, Eigen::Isometry3d> m_poses;
	std::map<long long, int> m_fixed, m_node_of_id;	 // m_fixed: id to line
	std::vector<TFileEdge> m_edges;
};

void writePose(std::ostream& out, const Eigen::Isometry3d& T)
{
	const Eigen::Quaterniond q(T.linear());
	out << T.translation().x() << ' ' << T.translation().y() << ' ' << T.translation().z() << ' ' << q.x()
		<< ' ' << q.y() << ' ' << q.z() << ' ' << q.w();
}

void writeEdge(
	std::ostream& out, const TPoseEdge& edge, const TNodeStates& states, const std::vector<long long>& ids)
{
	out << "EDGE_SE3:QUAT " << ids[edge.from] << ' ' << ids[edge.to] << ' ';
	writePose(
		out, edge.error_variable < 0 ? edge.T_from_to
									 : correctedMeasurement(edge, states.values[edge.error_variable]));
	const Matrix6d information = informationToG2o(edge.information);
	for (int i = 0; i < 6; i++)
		for (int j = i; j < 6; j++)
			out << ' ' << information(i, j);
	out << '\n';
}

std::vector<long long> idsOrOwn(const CPoseGraph& graph, std::vector<long long> ids)
{
	if (ids.empty()) {
		ids.resize(graph.nodeCount());
		std::iota(ids.begin(), ids.end(), 0);
	}
	if (ids.size() != graph.nodeCount() || std::set<long long>(ids.begin(), ids.end()).size() != ids.size())
		throw CError(
			"g2o ids", std::to_string(ids.size()) + " for " + std::to_string(graph.nodeCount()) + " nodes",
			"give each node one id of its own");
	return ids;
}
}  // namespace

TG2oGraph readG2o(const std::string& path)
{
	return CG2oReader(path).read();
}

void writeG2o(const std::string& path, const CPoseGraph& graph, const std::vector<long long>& file_ids)
{
	const auto ids = idsOrOwn(graph, file_ids);
	writeFileWhole(path, [&](std::ostream& out) {
		out.imbue(std::locale::classic());
		out << std::setprecision(17);
		for (int node = 0; node < int(graph.nodeCount()); node++) {
			if (graph.nodeKind(node) != ENodeKind::Pose) continue;
			out << "VERTEX_SE3:QUAT " << ids[node] << ' ';
			writePose(out, graph.pose(node));
			out << '\n';
			if (graph.isFixed(node)) out << "FIX " << ids[node] << '\n';
		}
		for (const TPoseEdge& edge : graph.edges())
			writeEdge(out, edge, graph.states(), ids);
	});
}
}  // namespace posidonia
