#pragma once

#include <cstddef>
#include <vector>

namespace posidonia
{
/** Sets of variables, one after the other. */
struct TVariableSets
{
	std::vector<int> starts{0}, members;

	size_t size() const { return starts.size() - 1; }
	void add(const int* first, const int* last)
	{
		members.insert(members.end(), first, last);
		starts.push_back(int(members.size()));
	}
};

/** Cliques of variables that are eliminated together (supernodes, the nodes of a Bayes tree), children before
 * their parents. A clique's pivots are consecutive in the elimination order; its separator are the variables
 * eliminated later that its pivots are coupled with once all before them are gone. */
struct TEliminationForest
{
	struct TClique
	{
		int first{0}, pivots{0};	 ///< pivots are the positions first .. first + pivots - 1
		std::vector<int> separator;	 ///< positions, ascending
		int parent{-1};				 ///< -1: a root
		std::vector<int> children;

		int left() const { return int(separator.size()); }
		int size() const { return pivots + left(); }
	};

	std::vector<int> order;	 ///< order[position] = variable
	std::vector<TClique> cliques;
	std::vector<int> clique_of;	 ///< of each position
};

/** How a forest is cut and ordered beyond what the fill asks for. */
struct TForestWishes
{
	/** Of each variable, or empty: within a clique, where any order will do, pivots of a higher number come
	 * last, so that a change to one of them touches little. */
	std::vector<double> late;
	int max_pivots{1 << 30};  ///< Larger cliques are cut into chains
};

/** The forest in which variables 0 .. n-1, already in a fill-reducing order, are eliminated. The order is
 * changed to an equivalent one in which each clique's pivots are neighbours (a postorder). Cliques are
 * joined, at the price of some zeros in the factor, wherever a model of the time for eliminating fronts says
 * that this pays.
 * @param sets every two members of a set are coupled; each ascending, without repeats */
TEliminationForest eliminationForest(int n, const TVariableSets& sets, const TForestWishes& wishes = {});
}  // namespace posidonia
