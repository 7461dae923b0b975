#include <posidonia/posegraph/robust_loss.h>

#include <cmath>

namespace posidonia
{
double robustCost(const TRobustLoss& loss, double s)
{
	const double k2 = loss.scale * loss.scale;
	switch (loss.kind) {
		case ERobustLoss::Huber:
			return s <= k2 ? s : 2 * loss.scale * std::sqrt(s) - k2;
		case ERobustLoss::Cauchy:
			return k2 * std::log1p(s / k2);
		case ERobustLoss::None:
			break;
	}
	return s;
}

double robustWeight(const TRobustLoss& loss, double s)
{
	const double k2 = loss.scale * loss.scale;
	switch (loss.kind) {
		case ERobustLoss::Huber:
			return s <= k2 ? 1 : loss.scale / std::sqrt(s);
		case ERobustLoss::Cauchy:
			return 1 / (1 + s / k2);
		case ERobustLoss::None:
			break;
	}
	return 1;
}
}  // namespace posidonia
