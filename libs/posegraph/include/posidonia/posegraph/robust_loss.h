#pragma once

namespace posidonia
{
/** How an edge's squared Mahalanobis distance s becomes cost. */
enum class ERobustLoss
{
	None,	///< rho(s) = s
	Huber,	///< rho(s) = s below scale^2, then 2 scale sqrt(s) - scale^2
	Cauchy	///< rho(s) = scale^2 log(1 + s / scale^2)
};

struct TRobustLoss
{
	ERobustLoss kind{ERobustLoss::None};
	double scale{1.0};	///< Mahalanobis distance sqrt(s) where the loss departs from quadratic [-], > 0
};

/** rho(s), the edge's share of the robust cost. */
double robustCost(const TRobustLoss& loss, double s);

/** rho'(s) in (0, 1]: the weight of the edge's information in iteratively re-weighted least squares
 * (Holland, Welsch 1977). */
double robustWeight(const TRobustLoss& loss, double s);
}  // namespace posidonia
