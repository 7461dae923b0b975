#pragma once

#include <limits>
#include <string>
#include <vector>

/** Options of a part are a plain struct with defaults and one template method that lists its keys:
 *
 *   struct TRoiOptions
 *   {
 *       double radius{4.0};
 *       bool enabled{true};
 *       template <class VISITOR>
 *       void visit(VISITOR& v)
 *       {
 *           v.number("roi_radius", radius, above(0), "Loop-candidate search radius [m] (paper sec. 3.2)");
 *           v.flag("enabled", enabled, "...");
 *       }
 *   };
 *
 * From that one list come the reading of ini files, the checks, --dump-config and the documentation. */
namespace posidonia
{
/** Allowed range of a number, both ends closed unless `open_min`. */
struct TRange
{
	double min{-std::numeric_limits<double>::infinity()};
	double max{std::numeric_limits<double>::infinity()};
	bool open_min{false};

	bool holds(double x) const { return (open_min ? x > min : x >= min) && x <= max; }
	/** "must be > 0", "must be in [0, 1]" ... */
	std::string text() const;
};
inline TRange above(double bound)
{
	return {bound, std::numeric_limits<double>::infinity(), true};
}
inline TRange atLeast(double bound)
{
	return {bound, std::numeric_limits<double>::infinity(), false};
}
inline TRange between(double lo, double hi)
{
	return {lo, hi, false};
}
inline TRange anyNumber()
{
	return {};
}

/** A key as documentation sees it. */
struct TOptionDoc
{
	std::string key, value, range, text;
};

/** Lists keys with their present values: for --dump-config, reports and the documentation. */
class COptionLister
{
   public:
	std::vector<TOptionDoc> rows;

	void number(const char* key, double& value, const TRange& range, const char* text);
	void degrees(const char* key, double& radians, const TRange& range_deg, const char* text);
	void integer(const char* key, int& value, const TRange& range, const char* text);
	void seed(const char* key, unsigned& value, const char* text);
	void flag(const char* key, bool& value, const char* text);
	void text(const char* key, std::string& value, const char* text);
	void choice(const char* key, std::string& value, const std::vector<std::string>& names, const char* text);
	/** Exactly `n` blank-separated numbers (n = 0: any count). */
	void numbers(
		const char* key, std::vector<double>& values, size_t n, const TRange& range, const char* text);
};

template <class OPTIONS>
std::vector<TOptionDoc> listOptions(OPTIONS options)
{
	COptionLister lister;
	options.visit(lister);
	return lister.rows;
}
}  // namespace posidonia
