#include "eval_testing.h"

#include <posidonia/eval/metrics.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/eval/text_table.h>

using namespace posidonia;
using namespace posidonia::testing;

namespace
{
const TMetrics kRows{{"slam.mean", "m", 0.1 + 0.2}, {"slam.poses", "", 360}, {"a.max", "deg", 1e-12}};
}

TEST(Metrics, JsonIsStableAndInOrder)
{
	EXPECT_EQ(
		metricsJson(kRows),
		"{\n\t\"slam.mean\": {\n\t\t\"value\": 0.3,\n\t\t\"unit\": \"m\"\n\t},\n"
		"\t\"slam.poses\": {\n\t\t\"value\": 360,\n\t\t\"unit\": \"\"\n\t},\n"
		"\t\"a.max\": {\n\t\t\"value\": 1e-12,\n\t\t\"unit\": \"deg\"\n\t}\n}\n");
	EXPECT_EQ(metricsJson({}), "{}\n");
}

TEST(Metrics, JsonRoundTrip)
{
	TMetrics rows = kRows;
	rows.push_back({"none", "m", std::nan("")});
	const CTextFile file("");
	writeMetricsJson(file.path(), rows);
	const TMetrics read = readMetricsJson(file.path());
	ASSERT_EQ(read.size(), rows.size());
	for (size_t i = 0; i < 3; i++) {
		EXPECT_EQ(read[i].what, rows[i].what);
		EXPECT_EQ(read[i].unit, rows[i].unit);
		EXPECT_NEAR(read[i].value, rows[i].value, 1e-9 * std::abs(rows[i].value));
	}
	EXPECT_TRUE(std::isnan(read[3].value));
}

TEST(Metrics, BadFilesAndNamesAreSaid)
{
	const CTextFile broken("{\"a\": {\"value\": 1}");
	expectContains(
		errorOf([&] { readMetricsJson(broken.path()); }), broken.path() + ": is not a metrics file");
	const CTextFile no_unit("{\"a\": {\"value\": 1}}");
	expectContains(errorOf([&] { readMetricsJson(no_unit.path()); }), "unit");
	const CTextFile array("[1, 2]");
	expectContains(errorOf([&] { readMetricsJson(array.path()); }), "is not a metrics file");
	expectContains(errorOf([] { metricsJson({{"a", "", 1}, {"a", "", 2}}); }), "two rows named 'a'");
	expectContains(errorOf([] { metric(kRows, "slam.men"); }), "did you mean 'slam.mean'?");
	EXPECT_EQ(metric(kRows, "slam.poses"), 360);
}

TEST(Metrics, CsvAndText)
{
	EXPECT_EQ(metricsCsv(kRows), "what,unit,value\nslam.mean,m,0.3\nslam.poses,,360\na.max,deg,1e-12\n");
	EXPECT_EQ(
		metricsText(kRows),
		"what        value  unit\n"
		"----------  -----  ----\n"
		"slam.mean     0.3  m\n"
		"slam.poses    360\n"
		"a.max       1e-12  deg\n");
}

TEST(TextTable, AlignsByCharactersNotBytes)
{
	CTextTable table({"Größe", "n"});
	table.add({"a", "1.25"});
	table.add({"größer", "-"});
	EXPECT_EQ(table.text(), "Größe      n\n------  ----\na       1.25\ngrößer     -\n");
	expectContains(errorOf([&] { table.add({"one"}); }), "1 cells under 2 heads");
	EXPECT_EQ(CTextTable({"a", "b"}).text(), "a  b\n-  -\n");
}

TEST(NumberText, FixedAndSignificant)
{
	EXPECT_EQ(fixedText(-0.0001, 2), "0.00");
	EXPECT_EQ(fixedText(-0.006, 2), "-0.01");
	EXPECT_EQ(fixedText(1403636579.763555584, 9), "1403636579.763555527");
	EXPECT_EQ(significantText(-0.0, 6), "0");
	EXPECT_EQ(significantText(123456789.0, 6), "1.23457e+08");
	EXPECT_EQ(fixedText(1e308, 2).size(), 309u + 3u);
}
