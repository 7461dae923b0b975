#pragma once

#include <Eigen/Dense>
#include <string>
#include <vector>

namespace posidonia
{
/** How a curve looks. Told apart by dash and width as well as by colour, so that a colour-blind reader or a
 * grey print loses nothing. */
struct TLineStyle
{
	std::string colour{"#000000"};
	double width{1.5};	 ///< [px]
	std::string dash{};	 ///< SVG stroke-dasharray; empty: solid
	double opacity{1};	 ///< 0 ... 1
};

/** Okabe and Ito's colours, safe for all common colour blindnesses, in the paper's roles. */
namespace styles
{
inline TLineStyle odometry()
{
	return {"#d55e00", 1.6, "7 3.5", 1};
}  ///< red, dashed
inline TLineStyle truth()
{
	return {"#009e73", 4.0, "", 0.55};
}  ///< green, broad: other curves show on top
inline TLineStyle slam()
{
	return {"#0072b2", 1.5, "", 1};
}  ///< blue, thin, solid
inline TLineStyle loops()
{
	return {"#0072b2", 0.9, "1.5 2", 0.85};
}  ///< blue, dotted
inline TLineStyle rejectedLoops()
{
	return {"#cc79a7", 1.6, "", 1};
}  ///< pink
}  // namespace styles

/** Lines between points; a point that is not finite breaks a line and is not drawn. */
struct TCurve
{
	std::string name;  ///< legend; empty: not in the legend
	TLineStyle style;
	std::vector<Eigen::Vector2d> points;  ///< (horizontal, vertical), units of the axes
	bool segments{false};				  ///< points are pairs, each a line of its own
};

struct TAxisLabels
{
	std::string title, horizontal, vertical;
};

struct TPlotSize
{
	double width{560}, height{420};	 ///< of the box inside the axes, at most [px]
	bool equal_scale{false};  ///< a metre is as long in both directions: the box shrinks to the data's shape
	bool vertical_from_zero{false};	 ///< the vertical axis starts at 0
	size_t max_points{5000};		 ///< curves with more are thinned evenly, ends kept
};

/** A figure with axes, round ticks, grid, title and a legend right of the box, as one SVG document.
 * Throws CError when no curve has a finite point. Same input, same bytes. */
std::string svgPlot(const TAxisLabels& labels, const std::vector<TCurve>& curves, const TPlotSize& size = {});

/** & < > " as entities. */
std::string xmlEscaped(const std::string& text);
}  // namespace posidonia
