#pragma once

#include <posidonia/base/options.h>

#include <Eigen/Dense>

namespace posidonia
{
/** Section [Lamp]: the vehicle's own light, a point. Without it, even light falls from straight above. */
struct TLampOptions
{
	std::string kind{"none"};
	std::vector<double> position{0.2, 0, 0.1};
	double reference{2.5};

	bool on() const { return kind == "point"; }

	template <class VISITOR>
	void visit(VISITOR& v)
	{
		v.choice(
			"kind", kind, {"none", "point"}, "point: light falls off as 1 / distance^2 and in the water");
		v.numbers(
			"position", position, 3, anyNumber(), "Of the lamp, in the body: forward starboard down [m]");
		v.number(
			"reference", reference, above(0),
			"A floor that faces the lamp from here in clear water has the texture's grey [m]");
	}
};
}  // namespace posidonia
