#pragma once

namespace posidonia
{
/** How an edge's squared Mahalanobis distance s becomes cost. */
enum class ERobustLoss
{
	None,	 ///< rho(s) = s
	Huber,	 ///< rho(s) = s below scale^2, then 2 scale sqrt(s) - scale^2
	Cauchy,	 ///< rho(s) = scale^2 log(1 + s / scale^2)
	/** rho(s) = s below P = scale^2, then P (3 s - P) / (s + P): dynamic covariance scaling, whose weight is
	 * the square of min(1, 2 P / (P + s)) (Agarwal et al. 2013). */
	Dcs
};

struct TRobustLoss
{
	ERobustLoss kind{ERobustLoss::None};
	double scale{1.0};	///< Mahalanobis distance sqrt(s) where the loss departs from quadratic [-], > 0
	/** Factor on rho, >= 0; 0 switches the measurement off. Set by CGraduatedNonconvexity, for one. */
	double weight{1.0};
};

/** weight rho(s), the factor's share of the robust cost. */
double robustCost(const TRobustLoss& loss, double s);

/** weight rho'(s), rho' in (0, 1]: the weight of the information in iteratively re-weighted least squares
 * (Holland, Welsch 1977). */
double robustWeight(const TRobustLoss& loss, double s);

/** Factor on the loss that makes the information which the normal equations state, weights included, that
 * which the estimate has when the errors of `dof` numbers are Gaussian (README, "Optimiser"): above 1, since
 * a loss weighs good measurements down too, and their information is not lost by as much. */
double honestFactor(const TRobustLoss& loss, int dof);
}  // namespace posidonia
