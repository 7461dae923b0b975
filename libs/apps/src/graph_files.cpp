#include <posidonia/apps/graph_files.h>
#include <posidonia/base/files.h>
#include <posidonia/posegraph/chi2.h>
#include <posidonia/posegraph/g2o_file.h>
#include <posidonia/posegraph/mrpt_graph_file.h>

#include <filesystem>
#include <iomanip>

namespace posidonia
{
namespace
{
constexpr int kDigits = 17;

TGraphFile fromMrptFile(const std::string& path)
{
	TMrptGraphFile in = readMrptGraph(path);
	TGraphFile out{std::move(in.graph), std::move(in.file_ids), {}};
	if (in.edges_without_information > 0)
		out.warnings.push_back(
			path + ": " + std::to_string(in.edges_without_information) +
			" edges have no information in the file; the identity is taken, as MRPT does");
	return out;
}

TGraphFile fromG2oFile(const std::string& path)
{
	TG2oGraph in = readG2o(path);
	return {std::move(in.graph), std::move(in.file_ids), {}};
}

void writeCsv(const std::string& path, const std::function<void(std::ostream&)>& write)
{
	writeFileWhole(path, [&](std::ostream& out) {
		out.imbue(std::locale::classic());
		out << std::setprecision(kDigits);
		write(out);
	});
}
}  // namespace

TGraphFile readGraphFile(const std::string& path)
{
	requireFile(path, "give a pose graph, .g2o or MRPT's .graph");
	return std::filesystem::path(path).extension() == ".graph" ? fromMrptFile(path) : fromG2oFile(path);
}

void writeEdgeWeights(
	const std::string& path, const TGraphFile& file, const std::vector<double>& edge_weights)
{
	const std::vector<double> s = edgesMahalanobis2(file.graph);
	writeCsv(path, [&](std::ostream& out) {
		out << "edge,from,to,weight,chi2\n";
		for (size_t k = 0; k < s.size(); k++) {
			const TPoseEdge& edge = file.graph.edges()[k];
			out << k << ',' << file.file_ids[static_cast<size_t>(edge.from)] << ','
				<< file.file_ids[static_cast<size_t>(edge.to)] << ',' << edge_weights[k] << ',' << s[k]
				<< '\n';
		}
	});
}

void writeMarginals(const std::string& path, const TGraphFile& file, const std::vector<Matrix6d>& covariances)
{
	writeCsv(path, [&](std::ostream& out) {
		out << "node";
		for (int r = 1; r <= 6; r++)
			for (int c = 1; c <= r; c++)
				out << ",c" << r << c;
		out << ",sigma_north,sigma_east,sigma_down\n";
		for (size_t n = 0; n < covariances.size(); n++) {
			if (file.graph.isFixed(static_cast<int>(n))) continue;
			out << file.file_ids[n];
			for (int r = 0; r < 6; r++)
				for (int c = 0; c <= r; c++)
					out << ',' << covariances[n](r, c);
			const Eigen::Matrix3d R = file.graph.pose(static_cast<int>(n)).linear();
			const Eigen::Matrix3d in_map = R * covariances[n].topLeftCorner<3, 3>() * R.transpose();
			for (int k = 0; k < 3; k++)
				out << ',' << std::sqrt(in_map(k, k));
			out << '\n';
		}
	});
}
}  // namespace posidonia
