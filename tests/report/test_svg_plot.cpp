#include "svg_testing.h"

#include <gtest/gtest.h>
#include <posidonia/base/error.h>
#include <posidonia/report/svg_plot.h>

using namespace posidonia;
using namespace posidonia::testing;
using Eigen::Vector2d;

namespace
{
const double kNan = std::nan("");
const std::vector<Vector2d> kPoints{{-3, 0.5}, {1.25, 7}, {12, 2}};

std::string plotOf(const std::vector<Vector2d>& points, const TPlotSize& size = {})
{
	return svgPlot({"A title", "u [m]", "v [m]"}, {{"curve", styles::slam(), points}}, size);
}

void expectNothingNonFinite(const std::string& svg)
{
	for (const char* word : {"nan", "inf", "NaN", "Inf"})
		EXPECT_EQ(svg.find(word), std::string::npos) << word;
}
}  // namespace

TEST(SvgTesting, TheCheckFindsWhatIsWrong)
{
	EXPECT_EQ(wellFormednessProblem("<a x=\"1\"><b/>t &lt; u</a>"), "");
	EXPECT_NE(wellFormednessProblem("<a><b></a></b>"), "");
	EXPECT_NE(wellFormednessProblem("<a>"), "");
	EXPECT_NE(wellFormednessProblem("<a x=1/>"), "");
	EXPECT_NE(wellFormednessProblem("<a>R&D</a>"), "");
}

TEST(SvgPlot, KnownPointsLandWhereTheTicksSay)
{
	for (bool equal : {false, true}) {
		TPlotSize size;
		size.equal_scale = equal;
		const std::string svg = plotOf(kPoints, size);
		const TAxisReader x(svg, 'x'), y(svg, 'y');
		const auto pixels = curvePixels(svg, 0);
		ASSERT_EQ(pixels.size(), kPoints.size());
		for (size_t i = 0; i < pixels.size(); i++) {
			EXPECT_NEAR(pixels[i].x(), x.pixel(kPoints[i].x()), 0.2) << "equal=" << equal << " i=" << i;
			EXPECT_NEAR(pixels[i].y(), y.pixel(kPoints[i].y()), 0.2) << "equal=" << equal << " i=" << i;
		}
		EXPECT_GT(x.scale(), 0);
		EXPECT_LT(y.scale(), 0) << "up is up";
		const double ratio = -y.scale() / x.scale();
		EXPECT_EQ(std::abs(ratio - 1) < 0.01, equal) << "equal=" << equal << " ratio=" << ratio;
	}
}

TEST(SvgPlot, PixelOfTheDocumentedFormula)
{
	TPlotSize size;
	size.width = 500;
	size.height = 300;
	size.vertical_from_zero = true;
	const auto pixels = curvePixels(plotOf({{0, 0}, {10, 2}}, size), 0);
	// 4 % of air: x in [-0.4, 10.4], y in [0, 2.08].
	EXPECT_NEAR(pixels[0].x(), 66 + 500 * 0.4 / 10.8, 0.06);
	EXPECT_NEAR(pixels[0].y(), 44 + 300, 0.06);
	EXPECT_NEAR(pixels[1].x(), 66 + 500 * 10.4 / 10.8, 0.06);
	EXPECT_NEAR(pixels[1].y(), 44 + 300 * (1 - 2 / 2.08), 0.06);
}

TEST(SvgPlot, WellFormedWithAwkwardWordsAndPoints)
{
	const std::string svg = svgPlot(
		{"a < b & \"c\" > d", "u", "v"},
		{{"R&D <1>", styles::loops(), {{0, 0}, {kNan, 1}, {1, 1}, {2, INFINITY}, {3, 1}}}});
	EXPECT_EQ(wellFormednessProblem(svg), "");
	expectNothingNonFinite(svg);
	EXPECT_NE(svg.find("R&amp;D &lt;1&gt;"), std::string::npos);
	EXPECT_EQ(curvePixels(svg, 0).size(), 3u);
}

TEST(SvgPlot, DegenerateDataStillDraw)
{
	const std::vector<std::vector<Vector2d>> cases{
		{{3, 4}}, {{0, 0}, {0, 0}}, {{0, 1}, {5, 1}}, {{1, 0}, {1, 8}}, {{1e6, 1e6}, {1e6, 1e6 + 1e-3}}};
	for (size_t i = 0; i < cases.size(); i++)
		for (bool equal : {false, true}) {
			TPlotSize size;
			size.equal_scale = equal;
			const std::string svg = plotOf(cases[i], size);
			EXPECT_EQ(wellFormednessProblem(svg), "") << "i=" << i;
			expectNothingNonFinite(svg);
		}
	EXPECT_THROW(plotOf({}), CError);
	EXPECT_THROW(plotOf({{kNan, 0}}), CError);
}

TEST(SvgPlot, LongCurvesAreThinnedAndKeepTheirEnds)
{
	std::vector<Vector2d> points;
	for (int i = 0; i <= 20000; i++)
		points.emplace_back(i, std::sin(i * 1e-3));
	const std::string svg = plotOf(points);
	const auto pixels = curvePixels(svg, 0);
	EXPECT_EQ(pixels.size(), 5000u);
	const TAxisReader x(svg, 'x');
	EXPECT_NEAR(pixels.front().x(), x.pixel(0), 0.2);
	EXPECT_NEAR(pixels.back().x(), x.pixel(20000), 0.2);
}

TEST(SvgPlot, SameBytesAgain)
{
	EXPECT_EQ(plotOf(kPoints), plotOf(kPoints));
}
