#pragma once

#include <map>
#include <string>
#include <vector>

#include "simulated_survey.h"

/** Is the filter as accurate as it says? NEES of its states against the truth and NIS of its innovations
 * (Bar-Shalom, Li, Kirubarajan, *Estimation with Applications to Tracking and Navigation*, sec. 5.4). */
namespace posidonia::testing
{
/** NEES per degree of freedom, averaged over runs, at each instant. */
struct TAnees
{
	int degrees_of_freedom{3};
	std::vector<double> sum;  ///< Over runs, by instant
	int runs{0};

	void add(size_t instant, double nees);
	double at(size_t instant) const { return sum[instant] / (runs * degrees_of_freedom); }
	double mean() const;
	/** Two-sided 95 % band of at(): the chi-square quantiles (Wilson and Hilferty) over its degrees. */
	double low() const, high() const;
	double shareInside() const;
};

/** Normalised innovations squared of one sensor, before the gate. */
struct TNis
{
	double sum{0}, squares{0}, products{0}, last{0};
	long dof{0}, count{0};
	void add(const TInnovation& innovation);
	void endOfRun() { last = -1; }
	double mean() const { return sum / static_cast<double>(dof); }	///< Per degree of freedom
	/** Of neighbours' NIS, each per degree of freedom less its mean. */
	double lag1() const;
};

struct TConsistency
{
	/** position (north, east: while GPS), depth, velocity, attitude, gyro bias, edge */
	std::map<std::string, TAnees> anees;
	std::map<std::string, TNis> nis;  ///< By label
	int runs{0};
	TConsistency& operator+=(const TConsistency& other);
};

/** Runs the scene; an instant each `period` [s], an edge (a node each `edge_time` s) ends there. */
void addRun(TConsistency& to, const TSurveyScene& scene, double period = 60, double edge_time = 1.5);
/** The same where the world's sensors are others than those that the filter is told of. */
void addRun(
	TConsistency& to, const TSurveyScene& told, const TSensorSuite& world, double period = 60,
	double edge_time = 1.5);
/** A table a reader can judge. */
std::string text(const TConsistency& c);
}  // namespace posidonia::testing
