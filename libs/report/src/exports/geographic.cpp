#include <posidonia/base/error.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/report/exports.h>
#include <posidonia/report/svg_plot.h>

#include <nlohmann/json.hpp>

namespace posidonia
{
namespace
{
struct TLine
{
	const char *name, *colour;	///< aabbggrr, as KML has it
	const TTrajectory* poses;
};

/** The lines that the run has: the final nodes or else the filter, and the truth. */
std::vector<TLine> linesOf(const TRunData& run)
{
	const bool slam = !run.trajectory("nodes").empty();
	std::vector<TLine> lines;
	const auto add = [&](const char* name, const char* colour, const TTrajectory& poses) {
		if (!poses.empty()) lines.push_back({name, colour, &poses});
	};
	add(slam ? "SLAM, final nodes" : "navigation filter", "ffb27200", run.trajectory(slam ? "nodes" : "ekf"));
	add("ground truth", "8f739e00", run.trajectory("truth"));
	if (lines.empty()) throw CError(run.folder, "holds no poses", "run it to its end");
	return lines;
}

/** Poses about half a metre or more apart: a line needs no more. */
std::vector<TGeodetic> wayOf(const TTrajectory& poses, const TWorldOptions& datum)
{
	std::vector<TGeodetic> way;
	Eigen::Vector3d last(1e9, 0, 0);
	for (const TStampedPose& pose : poses) {
		const Eigen::Vector3d p = pose.T.translation();
		if ((p - last).norm() < 0.4 && &pose != &poses.back()) continue;
		way.push_back(geodeticFromNed(p, datum));
		last = p;
	}
	return way;
}

std::string degrees(double value)
{
	return fixedText(value, 9);
}
std::string metres(double value)
{
	return fixedText(value, 3);
}
}  // namespace

std::string kmlOf(const TRunData& run)
{
	std::string kml =
		"<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<kml "
		"xmlns=\"http://www.opengis.net/kml/2.2\">\n<Document>\n<name>" +
		xmlEscaped(run.info.title) + "</name>\n";
	for (const TLine& line : linesOf(run)) {
		kml += std::string("<Placemark>\n<name>") + line.name + "</name>\n<Style><LineStyle><color>" +
			   line.colour +
			   "</color><width>2</width></LineStyle></Style>\n"
			   "<LineString><altitudeMode>absolute</altitudeMode><coordinates>\n";
		for (const TGeodetic& g : wayOf(*line.poses, run.info.datum))
			kml += degrees(g.longitude) + "," + degrees(g.latitude) + "," + metres(g.height) + "\n";
		kml += "</coordinates></LineString>\n</Placemark>\n";
	}
	return kml + "</Document>\n</kml>\n";
}

std::string geoJsonOf(const TRunData& run)
{
	nlohmann::ordered_json features = nlohmann::ordered_json::array();
	for (const TLine& line : linesOf(run)) {
		nlohmann::ordered_json way = nlohmann::ordered_json::array();
		for (const TGeodetic& g : wayOf(*line.poses, run.info.datum))
			way.push_back(
				{std::stod(degrees(g.longitude)), std::stod(degrees(g.latitude)),
				 std::stod(metres(g.height))});
		features.push_back(
			{{"type", "Feature"},
			 {"properties", {{"name", line.name}, {"run", run.info.title}}},
			 {"geometry", {{"type", "LineString"}, {"coordinates", way}}}});
	}
	return nlohmann::ordered_json{{"type", "FeatureCollection"}, {"features", features}}.dump(1, '\t') + "\n";
}

std::string photoPositionsCsv(const TRunData& run)
{
	std::string csv = "image,lat,lon,depth,roll,pitch,yaw\n";
	for (const TNodeRow& node : run.nodes) {
		if (node.picture.empty() || !run.camera) continue;
		const Eigen::Vector3d at = (node.T_map_body * run.camera->T_body_camera).translation();
		const TGeodetic g = geodeticFromNed(at, run.info.datum);
		const Eigen::Vector3d ypr = yawPitchRoll(node.T_map_body.linear()) * (180 / M_PI);
		csv += node.picture + "," + degrees(g.latitude) + "," + degrees(g.longitude) + "," + metres(at.z());
		for (const int k : {2, 1, 0})
			csv += "," + metres(ypr[k]);
		csv += "\n";
	}
	return csv;
}
}  // namespace posidonia
