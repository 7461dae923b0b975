#include <posidonia/posegraph/robust_loss.h>

#include <cmath>

namespace posidonia
{
namespace
{
double rho(const TRobustLoss& loss, double s)
{
	const double k2 = loss.scale * loss.scale;
	switch (loss.kind) {
		case ERobustLoss::Huber:
			return s <= k2 ? s : 2 * loss.scale * std::sqrt(s) - k2;
		case ERobustLoss::Cauchy:
			return k2 * std::log1p(s / k2);
		case ERobustLoss::Dcs:
			return s <= k2 ? s : k2 * (3 * s - k2) / (s + k2);
		case ERobustLoss::None:
			break;
	}
	return s;
}

double rhoDerivative(const TRobustLoss& loss, double s)
{
	const double k2 = loss.scale * loss.scale;
	switch (loss.kind) {
		case ERobustLoss::Huber:
			return s <= k2 ? 1 : loss.scale / std::sqrt(s);
		case ERobustLoss::Cauchy:
			return 1 / (1 + s / k2);
		case ERobustLoss::Dcs: {
			const double scaling = 2 * k2 / (k2 + s);
			return s <= k2 ? 1 : scaling * scaling;
		}
		case ERobustLoss::None:
			break;
	}
	return 1;
}
}  // namespace

double honestFactor(const TRobustLoss& loss, int dof)
{
	// Simpson's rule over the density of sqrt(s), which need not be normalised.
	constexpr int kSteps = 200;
	const double last = std::sqrt(double(dof)) + 8, step = last / kSteps;
	double w = 0, ws = 0, wws = 0;
	for (int k = 1; k <= kSteps; k++) {
		const double r = k * step, s = r * r, weight = rhoDerivative(loss, s);
		const double density = (k % 2 ? 4 : 2) * std::pow(r, dof - 1) * std::exp(-s / 2);
		w += density * weight;
		ws += density * weight * s / dof;
		wws += density * weight * weight * s / dof;
	}
	return ws * ws / (wws * w);
}

double robustCost(const TRobustLoss& loss, double s)
{
	return loss.weight * rho(loss, s);
}

double robustWeight(const TRobustLoss& loss, double s)
{
	return loss.weight * rhoDerivative(loss, s);
}
}  // namespace posidonia
