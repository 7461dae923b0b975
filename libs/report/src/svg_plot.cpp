#include <posidonia/base/error.h>
#include <posidonia/eval/number_text.h>
#include <posidonia/report/axis_ticks.h>
#include <posidonia/report/svg_plot.h>

#include <algorithm>
#include <cmath>

namespace posidonia
{
using Eigen::Vector2d;

namespace
{
constexpr double kLeft = 66, kTop = 44, kBottom = 56, kRight = 18;	///< margins around the box [px]
constexpr double kLegendRow = 22, kLegendLine = 34, kLetter = 6.8;	///< [px]
constexpr double kMinBox = 230;	 ///< [px]: room for the labels of a narrow figure
const std::string kText = "#222222", kGrid = "#e3e3e3", kFrame = "#777777";

std::string px(double x)
{
	return fixedText(x, 1);
}

std::string attribute(const std::string& name, const std::string& value)
{
	return ' ' + name + "=\"" + value + '"';
}

/** Data range on both axes. */
using TRange2 = Eigen::AlignedBox2d;

TRange2 dataRange(const std::vector<TCurve>& curves)
{
	TRange2 range;
	for (const auto& curve : curves)
		for (const auto& p : curve.points)
			if (p.allFinite()) range.extend(p);
	if (range.isEmpty()) throw CError("plot", "no curve has a point to draw", "is the run empty?");
	return range;
}

/** 4 % of air around the data, and a width where the data have none. */
TRange2 withAir(TRange2 range, bool vertical_from_zero)
{
	const double least = std::max(1e-6, 1e-3 * range.sizes().maxCoeff());
	const Vector2d air = (0.04 * range.sizes()).cwiseMax(Vector2d(least, least));
	range = TRange2(range.min() - air, range.max() + air);
	if (vertical_from_zero) range.min().y() = 0;
	return range;
}

/** Widens the box's range about its centre to `width` x `height` in data units. */
TRange2 widened(const TRange2& range, const Vector2d& sizes)
{
	return TRange2(range.center() - sizes / 2, range.center() + sizes / 2);
}

/** Where data land on the page. */
struct TFrame
{
	TRange2 range;
	double width{0}, height{0};	 ///< of the box [px]

	Vector2d pixel(const Vector2d& p) const
	{
		const Vector2d share = (p - range.min()).cwiseQuotient(range.sizes());
		return {kLeft + share.x() * width, kTop + (1 - share.y()) * height};
	}
};

TFrame frameFor(const std::vector<TCurve>& curves, const TPlotSize& size)
{
	const TRange2 range = withAir(dataRange(curves), size.vertical_from_zero);
	if (!size.equal_scale) return {range, size.width, size.height};
	const Vector2d page(size.width, size.height);
	const double scale = page.cwiseQuotient(range.sizes()).minCoeff();	// [px] a unit
	const Vector2d box = (scale * range.sizes()).cwiseMax(Vector2d(kMinBox, kMinBox)).cwiseMin(page);
	return {widened(range, box / scale), box.x(), box.y()};
}

std::string line(
	const Vector2d& a, const Vector2d& b, const std::string& colour, const std::string& more = "")
{
	return "<line" + attribute("x1", px(a.x())) + attribute("y1", px(a.y())) + attribute("x2", px(b.x())) +
		   attribute("y2", px(b.y())) + attribute("stroke", colour) + more + "/>\n";
}

std::string text(
	const Vector2d& at, const std::string& anchor, const std::string& words, const std::string& more = "")
{
	return "<text" + attribute("x", px(at.x())) + attribute("y", px(at.y())) +
		   attribute("text-anchor", anchor) + more + '>' + xmlEscaped(words) + "</text>\n";
}

std::string strokeOf(const TLineStyle& style)
{
	std::string s =
		attribute("stroke", style.colour) + attribute("stroke-width", significantText(style.width, 3));
	if (!style.dash.empty()) s += attribute("stroke-dasharray", style.dash);
	if (style.opacity < 1) s += attribute("stroke-opacity", significantText(style.opacity, 3));
	return s;
}

std::string horizontalTicks(const TFrame& f)
{
	std::string svg;
	const double bottom = kTop + f.height;
	const TTicks ticks =
		roundTicks(f.range.min().x(), f.range.max().x(), std::max(3, static_cast<int>(f.width / 65)));
	for (double value : ticks.values) {
		const double x = f.pixel({value, f.range.min().y()}).x();
		svg += line({x, kTop}, {x, bottom}, kGrid);
		svg += line({x, bottom}, {x, bottom + 4}, kFrame);
		svg += text({x, bottom + 18}, "middle", ticks.label(value), attribute("class", "xtick"));
	}
	return svg;
}

std::string verticalTicks(const TFrame& f)
{
	std::string svg;
	const TTicks ticks =
		roundTicks(f.range.min().y(), f.range.max().y(), std::max(3, static_cast<int>(f.height / 60)));
	for (double value : ticks.values) {
		const double y = f.pixel({f.range.min().x(), value}).y();
		svg += line({kLeft, y}, {kLeft + f.width, y}, kGrid);
		svg += line({kLeft - 4, y}, {kLeft, y}, kFrame);
		svg += text({kLeft - 8, y + 4}, "end", ticks.label(value), attribute("class", "ytick"));
	}
	return svg;
}

std::string axes(const TFrame& f, const TAxisLabels& labels)
{
	const Vector2d middle(kLeft + f.width / 2, kTop + f.height / 2);
	const std::string turned = attribute("transform", "rotate(-90 18 " + px(middle.y()) + ")");
	return horizontalTicks(f) + verticalTicks(f) + "<rect" + attribute("x", px(kLeft)) +
		   attribute("y", px(kTop)) + attribute("width", px(f.width)) + attribute("height", px(f.height)) +
		   attribute("fill", "none") + attribute("stroke", kFrame) + "/>\n" +
		   text(
			   {kLeft, 26}, "start", labels.title,
			   attribute("font-size", "15") + attribute("font-weight", "bold")) +
		   text({middle.x(), kTop + f.height + 42}, "middle", labels.horizontal) +
		   text({18, middle.y()}, "middle", labels.vertical, turned);
}

/** At most `most` points, evenly by index, first and last kept. */
std::vector<Vector2d> thinned(const std::vector<Vector2d>& points, size_t most)
{
	if (points.size() <= most || most < 2) return points;
	std::vector<Vector2d> kept;
	for (size_t i = 0; i < most; i++)
		kept.push_back(points[i * (points.size() - 1) / (most - 1)]);
	return kept;
}

/** SVG path data: M starts a line, L goes on. */
std::string pathData(const TCurve& curve, const TFrame& f, size_t max_points)
{
	const auto points = curve.segments ? curve.points : thinned(curve.points, max_points);
	std::string d;
	bool down = false;
	for (size_t i = 0; i < points.size(); i++) {
		const bool starts = !down || (curve.segments && i % 2 == 0);
		down = points[i].allFinite();
		if (!down) continue;
		const Vector2d p = f.pixel(points[i]);
		d += (starts ? 'M' : 'L') + px(p.x()) + ' ' + px(p.y());
	}
	return d;
}

std::string curvePath(const TCurve& curve, const TFrame& f, size_t max_points)
{
	return "<path" + attribute("class", "curve") + attribute("fill", "none") +
		   attribute("stroke-linejoin", "round") + strokeOf(curve.style) +
		   attribute("d", pathData(curve, f, max_points)) + "/>\n";
}

std::vector<const TCurve*> named(const std::vector<TCurve>& curves)
{
	std::vector<const TCurve*> result;
	for (const auto& curve : curves)
		if (!curve.name.empty() && !curve.points.empty()) result.push_back(&curve);
	return result;
}

std::string legend(const std::vector<TCurve>& curves, const TFrame& f)
{
	std::string svg;
	Vector2d at(kLeft + f.width + 16, kTop + 12);
	for (const TCurve* curve : named(curves)) {
		svg += "<line" + attribute("x1", px(at.x())) + attribute("y1", px(at.y())) +
			   attribute("x2", px(at.x() + kLegendLine)) + attribute("y2", px(at.y())) +
			   strokeOf(curve->style) + "/>\n";
		svg +=
			text({at.x() + kLegendLine + 8, at.y() + 4}, "start", curve->name, attribute("class", "legend"));
		at.y() += kLegendRow;
	}
	return svg;
}

/** [px] of words in the plot's font, roughly. */
double widthOf(const std::string& words, double letter)
{
	return letter * static_cast<double>(words.size());
}

double legendWidth(const std::vector<TCurve>& curves)
{
	double width = 0;
	for (const TCurve* curve : named(curves))
		width = std::max(width, 16 + kLegendLine + 8 + widthOf(curve->name, kLetter));
	return width;
}
}  // namespace

std::string xmlEscaped(const std::string& raw)
{
	std::string escaped;
	for (char c : raw) {
		if (c == '&')
			escaped += "&amp;";
		else if (c == '<')
			escaped += "&lt;";
		else if (c == '>')
			escaped += "&gt;";
		else if (c == '"')
			escaped += "&quot;";
		else
			escaped += c;
	}
	return escaped;
}

std::string svgPlot(const TAxisLabels& labels, const std::vector<TCurve>& curves, const TPlotSize& size)
{
	const TFrame f = frameFor(curves, size);
	const double width = std::max(
		kLeft + f.width + legendWidth(curves) + kRight,
		kLeft + widthOf(labels.title, 1.25 * kLetter) + kRight);
	const double height = kTop + f.height + kBottom;
	std::string svg = "<svg" + attribute("xmlns", "http://www.w3.org/2000/svg") +
					  attribute("viewBox", "0 0 " + px(width) + ' ' + px(height)) +
					  attribute("width", px(width)) + attribute("height", px(height)) +
					  attribute("font-family", "Helvetica, Arial, sans-serif") +
					  attribute("font-size", "12.5") + attribute("fill", kText) + ">\n<title>" +
					  xmlEscaped(labels.title) + "</title>\n<rect" + attribute("width", "100%") +
					  attribute("height", "100%") + attribute("fill", "white") + "/>\n";
	svg += axes(f, labels);
	for (const auto& curve : curves)
		if (!curve.points.empty()) svg += curvePath(curve, f, size.max_points);
	return svg + legend(curves, f) + "</svg>\n";
}
}  // namespace posidonia
