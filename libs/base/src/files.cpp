#include <posidonia/base/error.h>
#include <posidonia/base/files.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <numeric>
#include <sstream>

namespace fs = std::filesystem;

namespace posidonia
{
namespace
{
/** Removes a part file unless it was renamed. */
struct TPartFile
{
	std::string path;
	bool kept{false};
	~TPartFile()
	{
		std::error_code ignored;
		if (!kept) fs::remove(path, ignored);
	}
};
}  // namespace

void writeFileWhole(const std::string& path, const std::function<void(std::ostream&)>& write)
{
	TPartFile part{path + ".part"};
	{
		std::ofstream out(part.path, std::ios::binary | std::ios::trunc);
		if (!out)
			throw CError(
				part.path, "can't be opened for writing", "check that its folder exists and is writable");
		write(out);
		out.close();
		if (!out) throw CError(part.path, "can't be written", "is the disk full?");
	}
	std::error_code problem;
	fs::rename(part.path, path, problem);
	if (problem) throw CError(path, "can't be replaced: " + problem.message(), "check its permissions");
	part.kept = true;
}

std::string readFileText(const std::string& path)
{
	requireFile(path, "check the path");
	std::ifstream in(path, std::ios::binary);
	std::stringstream text;
	text << in.rdbuf();
	if (!in) throw CError(path, "can't be read", "check its permissions");
	return text.str();
}

void requireFile(const std::string& path, const std::string& way_out)
{
	if (!fs::exists(path)) throw CError(path, "no such file", way_out);
	if (fs::is_directory(path)) throw CError(path, "is a folder, a file was expected", way_out);
}

void makeFolder(const std::string& path)
{
	std::error_code problem;
	fs::create_directories(path, problem);
	if (problem)
		throw CError(path, "can't make this folder: " + problem.message(), "check its parent folder");
}

namespace
{
/** Levenshtein distance. */
size_t editDistance(const std::string& a, const std::string& b)
{
	std::vector<size_t> row(b.size() + 1);
	std::iota(row.begin(), row.end(), size_t{0});
	for (size_t i = 1; i <= a.size(); i++) {
		size_t diagonal = row[0];
		row[0] = i;
		for (size_t j = 1; j <= b.size(); j++) {
			const size_t substitute = diagonal + (a[i - 1] == b[j - 1] ? 0 : 1);
			diagonal = row[j];
			row[j] = std::min({row[j] + 1, row[j - 1] + 1, substitute});
		}
	}
	return row[b.size()];
}
}  // namespace

std::string didYouMean(const std::string& name, const std::vector<std::string>& known)
{
	if (known.empty()) return "nothing is known by such a name here";
	const auto closer = [&](const std::string& a, const std::string& b) {
		return editDistance(name, a) < editDistance(name, b);
	};
	const std::string& best = *std::min_element(known.begin(), known.end(), closer);
	if (editDistance(name, best) <= std::max<size_t>(2, name.size() / 3))
		return "did you mean '" + best + "'?";
	std::string list = "known are:";
	for (const auto& k : known)
		list += " " + k;
	return list;
}
}  // namespace posidonia
