#include <posidonia/vision/two_view_refinement.h>

#include <cmath>

namespace posidonia
{
using Eigen::Isometry3d;
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr int POINT_ITERATIONS = 8;
constexpr double POINT_CONVERGED = 1e-12;  // [m]
constexpr double POSE_CONVERGED = 1e-10;   // [m and rad]
/** Below this the cost's rounding hides whether a step goes down; Gauss-Newton is a contraction there. */
constexpr double TRUSTED_STEP = 1e-6;
constexpr double NEAREST = 1e-3;  // [m], points stay in front of the camera

/** (u, v, d) [px] of a point in left-camera coordinates. */
Vector3d projectUvd(const TStereoCamera& c, const Vector3d& p)
{
	const double iz = 1 / p.z();
	return {c.cx + c.fx * p.x() * iz, c.cy + c.fy * p.y() * iz, c.fx * c.baseline * iz};
}

Matrix3d projectUvdJacobian(const TStereoCamera& c, const Vector3d& p)
{
	const double iz = 1 / p.z(), iz2 = iz * iz;
	Matrix3d J;
	J << c.fx * iz, 0, -c.fx * p.x() * iz2, 0, c.fy * iz, -c.fy * p.y() * iz2, 0, 0, -c.fx * c.baseline * iz2;
	return J;
}

/** d(point in b) / d(rho, phi) of T_a_b. */
Eigen::Matrix<double, 3, 6> pointJacobian(const Vector3d& p_b)
{
	Eigen::Matrix<double, 3, 6> G;
	G << -Matrix3d::Identity(), skew(p_b);
	return G;
}
}  // namespace

double TTukeyLoss::cost(double s) const
{
	const double t = s < cutoff ? 1 - s / cutoff : 0;
	return cutoff / 3 * (1 - t * t * t);
}

double TTukeyLoss::weight(double s) const
{
	const double t = s < cutoff ? 1 - s / cutoff : 0;
	return t * t;
}

double TTukeyLoss::efficiency(int dof) const
{
	// M-estimation of a mean from spherical Gaussian residuals e in R^k, s = |e|^2: with psi = w(s) e the
	// covariance is b / a^2 of the least-squares one, a = E[w + 2 s w' / k], b = E[w^2 s] / k (Huber 1981).
	// Midpoint rule over r = |e| with density r^(k-1) exp(-r^2/2).
	constexpr int STEPS = 2000;
	const double step = std::sqrt(cutoff) / STEPS, far = 12;
	double norm = 0, a = 0, b = 0;
	for (int i = 0; i < static_cast<int>(far / step); i++) {
		const double r = (i + 0.5) * step, s = r * r, p = std::pow(r, dof - 1) * std::exp(-0.5 * s);
		const double t = s < cutoff ? 1 - s / cutoff : 0;
		norm += p;
		a += p * (t * t - 4 * t * s / (cutoff * dof));
		b += p * t * t * t * t * s / dof;
	}
	return a * a / (b * norm);
}

/** Normal equations of one point: own position H_aa + H_bb (both in b's axes), and residuals. */
struct CTwoViewRefinement::TPointTerms
{
	Vector3d r_a, r_b, p_b;
	Matrix3d H_a, H_b;	// information of the point from either key frame, in b's axes
	Vector3d g_a, g_b;	// gradients in b's axes
	double chi2;
};

CTwoViewRefinement::CTwoViewRefinement(
	const TStereoCamera& camera, const TKeyFrame& a, const TKeyFrame& b, const Matches& matches)
	: m_camera(camera), m_chi2(matches.size())
{
	const auto weights = [](const TStereoPoint& p) {
		const double uv = 1.0 / (double(p.sigma_uv) * p.sigma_uv), d = 1.0 / (double(p.sigma_d) * p.sigma_d);
		return Vector3d(uv, uv, d);
	};
	for (const auto& [i, j] : matches) {
		const TStereoPoint &p = a.points[i], &q = b.points[j];
		m_tracks.push_back({p.uvd(), q.uvd(), weights(p), weights(q), p.point, p.point});
	}
}

CTwoViewRefinement::TPointTerms CTwoViewRefinement::terms(const Isometry3d& T_b_a, const TTrack& t) const
{
	TPointTerms o;
	o.p_b = T_b_a * t.point;
	o.p_b.z() = std::max(o.p_b.z(), NEAREST);
	o.r_a = projectUvd(m_camera, t.point) - t.z_a;
	o.r_b = projectUvd(m_camera, o.p_b) - t.z_b;
	const Matrix3d J_a = projectUvdJacobian(m_camera, t.point) * T_b_a.linear().transpose();
	const Matrix3d J_b = projectUvdJacobian(m_camera, o.p_b);
	const Vector3d wr_a = t.w_a.cwiseProduct(o.r_a), wr_b = t.w_b.cwiseProduct(o.r_b);
	o.H_a = J_a.transpose() * t.w_a.asDiagonal() * J_a;
	o.H_b = J_b.transpose() * t.w_b.asDiagonal() * J_b;
	o.g_a = J_a.transpose() * wr_a;
	o.g_b = J_b.transpose() * wr_b;
	o.chi2 = o.r_a.dot(wr_a) + o.r_b.dot(wr_b);
	return o;
}

void CTwoViewRefinement::settlePoint(const Isometry3d& T_b_a, TTrack& t) const
{
	// Gauss-Newton from the last position, halved while the cost grows.
	TPointTerms now = terms(T_b_a, t);
	for (int i = 0; i < POINT_ITERATIONS; i++) {
		const Matrix3d H = now.H_a + now.H_b;
		Vector3d step = -(T_b_a.linear().transpose() * H.llt().solve(now.g_a + now.g_b));
		if (!step.allFinite() || step.norm() < POINT_CONVERGED) return;
		const Vector3d from = t.point;
		TPointTerms next;
		for (int halvings = 0; halvings < 6; halvings++, step *= 0.5) {
			t.point = from + step;
			t.point.z() = std::max(t.point.z(), NEAREST);
			next = terms(T_b_a, t);
			if (next.chi2 <= now.chi2 || step.norm() < TRUSTED_STEP) break;
		}
		if (next.chi2 > now.chi2 && step.norm() > TRUSTED_STEP) {
			t.point = from;
			return;
		}
		now = next;
		if (step.norm() < POINT_CONVERGED) return;
	}
}

void CTwoViewRefinement::settle(const Isometry3d& T_a_b)
{
	const Isometry3d T_b_a = T_a_b.inverse();
	for (size_t i = 0; i < m_tracks.size(); i++) {
		settlePoint(T_b_a, m_tracks[i]);
		m_chi2[i] = terms(T_b_a, m_tracks[i]).chi2;
	}
}

const std::vector<double>& CTwoViewRefinement::chi2(const Isometry3d& T_a_b)
{
	settle(T_a_b);
	return m_chi2;
}

Matrix6d CTwoViewRefinement::information(const Isometry3d& T_a_b, int match) const
{
	// Eliminating the point: H_b - H_b (H_a + H_b)^-1 H_b = (H_a^-1 + H_b^-1)^-1, the information of the
	// difference of two independently triangulated points.
	const TPointTerms t = terms(T_a_b.inverse(), m_tracks[match]);
	const auto G = pointJacobian(t.p_b);
	const Matrix3d M = t.H_a * (t.H_a + t.H_b).llt().solve(t.H_b);
	return G.transpose() * (0.5 * (M + M.transpose())) * G;
}

Vector6d CTwoViewRefinement::residual(const Isometry3d& T_a_b, int match) const
{
	TTrack track = m_tracks[match];
	settlePoint(T_a_b.inverse(), track);
	const TPointTerms t = terms(T_a_b.inverse(), track);
	Vector6d r;
	r << t.r_a, t.r_b;
	return r;
}

TLinearisation CTwoViewRefinement::linearise(const Isometry3d& T_a_b, const TTukeyLoss& loss)
{
	TLinearisation sum;
	const Isometry3d T_b_a = T_a_b.inverse();
	for (TTrack& track : m_tracks) {
		settlePoint(T_b_a, track);
		const TPointTerms t = terms(T_b_a, track);
		sum.cost += loss.cost(t.chi2);
		const double w = loss.weight(t.chi2);
		if (w == 0) continue;
		const auto G = pointJacobian(t.p_b);
		const Matrix3d M = t.H_a * (t.H_a + t.H_b).llt().solve(t.H_b);
		sum.H.noalias() += G.transpose() * (0.5 * w * (M + M.transpose())) * G;
		sum.g.noalias() += w * G.transpose() * t.g_b;
	}
	return sum;
}

bool CTwoViewRefinement::descend(const TTukeyLoss& loss, int max_iterations, double stop, Isometry3d& T_a_b)
{
	double lambda = 1e-6;
	TLinearisation now = linearise(T_a_b, loss);
	for (int i = 0; i < max_iterations; i++) {
		const Matrix6d damped = now.H + Matrix6d(lambda * now.H.diagonal().asDiagonal());
		const Eigen::LLT<Matrix6d> factor(damped);
		if (factor.info() != Eigen::Success) return false;
		const Vector6d step = -factor.solve(now.g);
		if (!step.allFinite()) return false;
		const Isometry3d next_pose = retract(T_a_b, step);
		const TLinearisation next = linearise(next_pose, loss);
		const double size = step.norm();
		if (next.cost > now.cost && size > TRUSTED_STEP) {
			lambda = std::max(1e-6, lambda * 10);
			if (lambda > 1e8) return false;
			continue;
		}
		T_a_b = next_pose;
		now = next;
		lambda *= 0.1;
		if (size < stop) return true;
	}
	return false;
}

bool CTwoViewRefinement::solve(const Isometry3d& start, const TTukeyLoss& loss, Isometry3d& T_a_b)
{
	for (TTrack& t : m_tracks)
		t.point = t.start;
	T_a_b = start;
	// RANSAC's pose is worse than the measurements: begin with a wide cut-off, so that no good point is lost.
	for (const double widening : {16.0, 4.0})
		descend(TTukeyLoss{widening * loss.cutoff}, 10, 1e-4, T_a_b);
	const bool converged = descend(loss, 100, POSE_CONVERGED, T_a_b);
	T_a_b = orthonormalized(T_a_b);
	return converged;
}
}  // namespace posidonia
