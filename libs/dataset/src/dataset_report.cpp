#include <mrpt/core/format.h>
#include <posidonia/dataset/import_dataset.h>

namespace posidonia
{
std::string TDatasetReport::text() const
{
	std::string out;
	for (const auto& [label, n] : observations)
		out += mrpt::format("%-10s %8zu observations\n", label.c_str(), n);
	if (observations.count("STEREO"))
		out += mrpt::format(
			"rig: %dx%d px, f %.3f %.3f, c %.3f %.3f px, baseline %.5f m%s\n", camera.width, camera.height,
			camera.fx, camera.fy, camera.cx, camera.cy, camera.baseline,
			rectified ? " (rectified now)" : " (was rectified)");
	out += mrpt::format("time: %.3f to %.3f s (%.1f s)\n", first_stamp, last_stamp, last_stamp - first_stamp);
	out += mrpt::format("ground truth: %zu poses\n", ground_truth_poses);
	if (datum)
		out += mrpt::format(
			"datum (%s): [World] latitude = %.9f, longitude = %.9f\n", datum_source.c_str(), datum->latitude,
			datum->longitude);
	if (levelled) {
		out += "levelled with\nT_FRD_body: [";
		for (int i = 0; i < 16; i++)
			out += mrpt::format(
				"%s%.9f", i ? (i % 4 ? ", " : ",\n             ") : "", T_FRD_body.matrix()(i / 4, i % 4));
		out += "]\n";
	}
	for (const auto& folder : absent)
		out += "absent: " + folder + "\n";
	for (const auto& note : notes)
		out += "note: " + note + "\n";
	for (const auto& warning : warnings)
		out += "warning: " + warning + "\n";
	if (bad_rows) out += mrpt::format("left out: %zu bad rows\n", bad_rows);
	return out;
}
}  // namespace posidonia
