#include <gtest/gtest.h>
#include <posidonia/obs/rawlog_writer.h>
#include <temp_folder.h>

#include <array>
#include <cstdio>

#include "sample_observations.h"

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
/** What a command prints on stdout and stderr. */
std::string output(const std::string& command)
{
	std::string text;
	FILE* pipe = popen((command + " 2>&1").c_str(), "r");
	if (!pipe) return text;
	std::array<char, 4096> buffer;
	while (const size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
		text.append(buffer.data(), n);
	pclose(pipe);
	return text;
}

/** MRPT's tools load the classes from the shared library; they exit 0 whatever happens, so the text counts.
 */
class RawlogEdit : public ::testing::Test
{
   protected:
	void SetUp() override
	{
		if (output("command -v rawlog-edit").empty())
			GTEST_SKIP() << "rawlog-edit (Debian: mrpt-apps) is not installed";
		CRawlogWriter writer(m_folder / "dive.rawlog");
		for (int i = 0; i < 3; i++) {
			writer.write(sampleDvl(1.6e9 + i));
			writer.write(samplePressure(1.6e9 + i + 0.5));
		}
		writer.finish();
	}
	std::string run(const std::string& what) const
	{
		// exports are written to the current folder
		return output(
			"cd " + m_folder.path() + " && rawlog-edit -p " + POSIDONIA_LIB_DIR + "/libposidonia-obs.so " +
			what + " -i dive.rawlog");
	}

	CTempFolder m_folder;
};
}  // namespace

TEST_F(RawlogEdit, InfoReadsEveryObject)
{
	const std::string text = run("--info");
	EXPECT_HOLDS(text, "Overall number of objects         : 6");
	EXPECT_HOLDS(text, "DVL, PRESSURE");
}

TEST_F(RawlogEdit, DescribeNamesOurClasses)
{
	const std::string text = run("--describe");
	EXPECT_HOLDS(text, "posidonia::CObservationDVL");
	EXPECT_HOLDS(text, "posidonia::CObservationPressure");
	EXPECT_HOLDS(text, "0.125 -0.25 0.0625 (valid)");
}

TEST_F(RawlogEdit, TextExportHoldsTheNumbers)
{
	run("--export-txt");
	std::string all;
	for (const auto& file : std::filesystem::directory_iterator(m_folder.path()))
		if (file.path().extension() == ".txt")
			all += file.path().filename().string() + "\n" + fileBytes(file.path());
	EXPECT_HOLDS(all, "dive_DVL.txt");
	EXPECT_HOLDS(all, "dive_PRESSURE.txt");
	EXPECT_HOLDS(all, "136789.437500");
	EXPECT_HOLDS(all, "-0.250000000");
	EXPECT_HOLDS(all, "2.515625000");
}
