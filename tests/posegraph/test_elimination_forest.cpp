#include <gtest/gtest.h>
#include <posidonia/posegraph/elimination_forest.h>
#include <posidonia/posegraph/elimination_order.h>

#include <algorithm>
#include <numeric>
#include <random>

using namespace posidonia;

namespace
{
using TPairs = std::vector<std::array<int, 2>>;

/** Sets of two to `largest` variables; few enough of them leave several separate graphs. */
TVariableSets randomSets(unsigned seed, int n, int count, int largest)
{
	std::mt19937 rng(seed);
	std::uniform_int_distribution<int> any(0, n - 1), size(2, largest), near(1, 6);
	TVariableSets sets;
	for (int k = 0; k < count; k++) {
		const int first = any(rng);
		std::vector<int> set{first};
		for (int more = size(rng); more > 1; more--)  // mostly neighbours, as in a survey, sometimes far
			set.push_back(k % 5 == 0 ? any(rng) : std::min(n - 1, first + near(rng)));
		std::sort(set.begin(), set.end());
		set.erase(std::unique(set.begin(), set.end()), set.end());
		sets.add(set.data(), set.data() + set.size());
	}
	return sets;
}

TPairs gridPairs(int side)
{
	TPairs pairs;
	for (int y = 0; y < side; y++)
		for (int x = 0; x < side; x++) {
			if (x + 1 < side) pairs.push_back({y * side + x, y * side + x + 1});
			if (y + 1 < side) pairs.push_back({y * side + x, y * side + x + side});
		}
	return pairs;
}

std::vector<int> inverseOf(const std::vector<int>& order)
{
	std::vector<int> position(order.size(), -1);
	for (size_t k = 0; k < order.size(); k++)
		position[size_t(order[k])] = int(k);
	return position;
}

bool isPermutation(std::vector<int> order)
{
	std::sort(order.begin(), order.end());
	for (size_t k = 0; k < order.size(); k++)
		if (order[k] != int(k)) return false;
	return true;
}

TEliminationForest forestOfPairs(int n, const TPairs& pairs, const std::vector<int>& order)
{
	const auto position = inverseOf(order);
	TVariableSets sets;
	for (const auto& [a, b] : pairs) {
		const int ends[2] = {
			std::min(position[size_t(a)], position[size_t(b)]),
			std::max(position[size_t(a)], position[size_t(b)])};
		sets.add(ends, ends + 2);
	}
	return eliminationForest(n, sets);
}

size_t factorBlocks(const TEliminationForest& forest)
{
	size_t blocks = 0;
	for (const auto& clique : forest.cliques)
		blocks += size_t(clique.pivots * (clique.pivots + 1) / 2 + clique.pivots * clique.left());
	return blocks;
}

struct TForestCase
{
	int n, sets, largest;
	bool late;
	int max_pivots;
};

class Forest : public ::testing::TestWithParam<TForestCase>
{
   protected:
	static constexpr unsigned kSeeds = 20;
	struct TMade
	{
		TVariableSets sets;
		TForestWishes wishes;
		TEliminationForest forest;
	};
	static TMade make(unsigned seed)
	{
		const TForestCase& c = GetParam();
		TMade made{randomSets(seed, c.n, c.sets, c.largest), {}, {}};
		made.wishes.max_pivots = c.max_pivots;
		std::mt19937 rng(seed + 1000);
		std::uniform_int_distribution<int> value(0, 20);
		for (int k = 0; c.late && k < c.n; k++)
			made.wishes.late.push_back(value(rng));
		made.forest = eliminationForest(c.n, made.sets, made.wishes);
		return made;
	}
};
}  // namespace

INSTANTIATE_TEST_SUITE_P(
	Random, Forest,
	::testing::Values(
		TForestCase{1, 0, 2, false, 1 << 30}, TForestCase{30, 8, 2, false, 1 << 30},
		TForestCase{60, 150, 2, false, 1 << 30}, TForestCase{200, 600, 4, false, 1 << 30},
		TForestCase{200, 600, 3, true, 1 << 30}, TForestCase{120, 500, 3, true, 5},
		TForestCase{40, 300, 3, false, 1}, TForestCase{300, 150, 5, true, 16}),
	[](const auto& info) {
		const auto& c = info.param;
		return std::to_string(c.n) + "Variables" + std::to_string(c.sets) + "Sets" + (c.late ? "Late" : "") +
			   (c.max_pivots < 1000 ? "Cut" : "");
	});

TEST_P(Forest, CliquesShareOutAllPositions)
{
	for (unsigned seed = 0; seed < kSeeds; seed++) {
		const auto forest = make(seed).forest;
		ASSERT_EQ(int(forest.order.size()), GetParam().n) << "seed=" << seed;
		EXPECT_TRUE(isPermutation(forest.order)) << "seed=" << seed;
		int next = 0;
		for (size_t c = 0; c < forest.cliques.size(); c++) {
			EXPECT_EQ(forest.cliques[c].first, next) << "seed=" << seed << " clique " << c;
			EXPECT_GE(forest.cliques[c].pivots, 1) << "seed=" << seed << " clique " << c;
			for (int k = 0; k < forest.cliques[c].pivots; k++)
				EXPECT_EQ(forest.clique_of[size_t(next++)], int(c)) << "seed=" << seed;
		}
		EXPECT_EQ(next, GetParam().n) << "seed=" << seed;
	}
}

/** What elimination couples stays within cliques: first the given couplings ... */
TEST_P(Forest, OfTwoCoupledVariablesTheLaterIsInTheFrontOfTheEarlier)
{
	for (unsigned seed = 0; seed < kSeeds; seed++) {
		const auto made = make(seed);
		const auto position = inverseOf(made.forest.order);
		for (size_t s = 0; s < made.sets.size(); s++)
			for (int i = made.sets.starts[s]; i < made.sets.starts[s + 1]; i++)
				for (int j = made.sets.starts[s]; j < i; j++) {
					const int a = position[size_t(made.sets.members[size_t(i)])],
							  b = position[size_t(made.sets.members[size_t(j)])];
					const int later = std::max(a, b);
					const auto& clique =
						made.forest.cliques[size_t(made.forest.clique_of[size_t(std::min(a, b))])];
					EXPECT_TRUE(
						later < clique.first + clique.pivots ||
						std::binary_search(clique.separator.begin(), clique.separator.end(), later))
						<< "seed=" << seed << " positions " << a << ", " << b;
				}
	}
}

/** ... then those that a clique leaves behind. */
TEST_P(Forest, SeparatorsAscendAndLieInTheParentsFront)
{
	for (unsigned seed = 0; seed < kSeeds; seed++) {
		const auto forest = make(seed).forest;
		for (size_t c = 0; c < forest.cliques.size(); c++) {
			const auto& clique = forest.cliques[c];
			const auto where = ::testing::Message() << "seed=" << seed << " clique " << c;
			EXPECT_EQ(clique.separator.empty(), clique.parent < 0) << where;
			if (clique.parent < 0) continue;
			ASSERT_GT(clique.parent, int(c)) << where << ": children come before parents";
			EXPECT_GE(clique.separator.front(), clique.first + clique.pivots) << where;
			EXPECT_EQ(
				std::adjacent_find(
					clique.separator.begin(), clique.separator.end(), std::greater_equal<int>()),
				clique.separator.end())
				<< where << ": not ascending";
			const auto& parent = forest.cliques[size_t(clique.parent)];
			EXPECT_EQ(std::count(parent.children.begin(), parent.children.end(), int(c)), 1) << where;
			for (const int j : clique.separator)
				EXPECT_TRUE(
					(j >= parent.first && j < parent.first + parent.pivots) ||
					std::binary_search(parent.separator.begin(), parent.separator.end(), j))
					<< where << " position " << j;
		}
		size_t children = 0, with_parent = 0;
		for (const auto& clique : forest.cliques) {
			children += clique.children.size();
			with_parent += clique.parent >= 0;
		}
		EXPECT_EQ(children, with_parent) << "seed=" << seed;
	}
}

/** A subtree is one piece of the list: what the threads of the batch factorisation rely on. Not so when
 * cliques are cut: a child of a chain's later piece stands before the earlier piece. */
TEST_P(Forest, SubtreesAreConsecutiveWhenNoCliqueIsCut)
{
	if (GetParam().max_pivots < GetParam().n) return;
	for (unsigned seed = 0; seed < kSeeds; seed++) {
		const auto forest = make(seed).forest;
		std::vector<int> first(forest.cliques.size()), count(forest.cliques.size(), 1);
		for (size_t c = 0; c < forest.cliques.size(); c++) {
			first[c] = int(c);
			for (const int child : forest.cliques[c].children) {
				first[c] = std::min(first[c], first[size_t(child)]);
				count[c] += count[size_t(child)];
			}
			EXPECT_EQ(first[c] + count[c], int(c) + 1) << "seed=" << seed << " clique " << c;
			EXPECT_EQ(
				forest.cliques[c].children.empty() ? int(c)
												   : first[size_t(forest.cliques[c].children.front())],
				first[c])
				<< "seed=" << seed << " clique " << c << ": the first child is the first in the list";
		}
	}
}

TEST_P(Forest, WishesAreRespected)
{
	for (unsigned seed = 0; seed < kSeeds; seed++) {
		const auto made = make(seed);
		for (size_t c = 0; c < made.forest.cliques.size(); c++) {
			const auto& clique = made.forest.cliques[c];
			EXPECT_LE(clique.pivots, made.wishes.max_pivots) << "seed=" << seed << " clique " << c;
			for (int p = clique.first + 1; !made.wishes.late.empty() && p < clique.first + clique.pivots; p++)
				EXPECT_LE(
					made.wishes.late[size_t(made.forest.order[size_t(p - 1)])],
					made.wishes.late[size_t(made.forest.order[size_t(p)])])
					<< "seed=" << seed << " clique " << c << " position " << p;
		}
	}
}

/** A cut clique is a chain: every piece sees all later ones. */
TEST(ForestWishes, ALargeCliqueBecomesAChainThatIsLateAsAWhole)
{
	TVariableSets sets;
	std::vector<int> all(23);
	std::iota(all.begin(), all.end(), 0);
	sets.add(all.data(), all.data() + all.size());
	TForestWishes wishes;
	wishes.max_pivots = 5;
	for (int k = 0; k < 23; k++)
		wishes.late.push_back((7 * k) % 23);
	const auto forest = eliminationForest(23, sets, wishes);
	ASSERT_EQ(forest.cliques.size(), 5u);
	for (size_t c = 0; c < 5; c++) {
		const auto& clique = forest.cliques[c];
		EXPECT_EQ(clique.parent, c < 4 ? int(c) + 1 : -1);
		EXPECT_EQ(clique.left(), 23 - clique.first - clique.pivots) << "clique " << c;
	}
	for (int p = 0; p < 23; p++)
		EXPECT_EQ(wishes.late[size_t(forest.order[size_t(p)])], p);
}

/** Joining cliques costs zeros, yet never turns a sparse graph into a dense one. */
TEST(ForestSize, JoinedCliquesStaySmall)
{
	TPairs chain;
	for (int k = 1; k < 2000; k++)
		chain.push_back({k - 1, k});
	const auto forest = forestOfPairs(2000, chain, minimumDegreeOrder(2000, chain));
	int largest = 0;
	for (const auto& clique : forest.cliques)
		largest = std::max(largest, clique.size());
	EXPECT_LE(largest, 12);
	EXPECT_LT(forest.cliques.size(), 1000u) << "nothing was joined";
	EXPECT_LT(factorBlocks(forest), size_t(6 * 2000));
}

TEST(EliminationOrder, MinimumDegreeIsAPermutationWithLittleFill)
{
	constexpr int kSide = 30, kN = kSide * kSide;
	const TPairs pairs = gridPairs(kSide);
	std::vector<int> natural(kN);
	std::iota(natural.begin(), natural.end(), 0);
	const auto order = minimumDegreeOrder(kN, pairs);
	ASSERT_EQ(int(order.size()), kN);
	EXPECT_TRUE(isPermutation(order));
	EXPECT_LT(
		2 * factorBlocks(forestOfPairs(kN, pairs, order)), factorBlocks(forestOfPairs(kN, pairs, natural)));
	EXPECT_TRUE(minimumDegreeOrder(0, {}).empty());
	EXPECT_TRUE(isPermutation(minimumDegreeOrder(4, {}))) << "nothing coupled";
}

TEST(EliminationOrder, PairsMayComeTwiceAndEitherWayRound)
{
	TPairs pairs = gridPairs(8);
	const size_t once = pairs.size();
	for (size_t k = 0; k < once; k++)
		pairs.push_back({pairs[k][1], pairs[k][0]});
	EXPECT_TRUE(isPermutation(minimumDegreeOrder(64, pairs)));
	EXPECT_TRUE(isPermutation(constrainedMinimumDegreeOrder(64, pairs, std::vector<int>(64, 0))));
}

TEST(EliminationOrder, LowerGroupsComeFirst)
{
	constexpr int kSide = 12, kN = kSide * kSide;
	for (unsigned seed = 0; seed < 10; seed++) {
		std::mt19937 rng(seed);
		std::vector<int> groups(kN);
		for (int& g : groups)
			g = int(rng() % 5);
		const auto order = constrainedMinimumDegreeOrder(kN, gridPairs(kSide), groups);
		ASSERT_TRUE(isPermutation(order)) << "seed=" << seed;
		for (size_t k = 1; k < size_t(kN); k++)
			EXPECT_LE(groups[size_t(order[k - 1])], groups[size_t(order[k])])
				<< "seed=" << seed << " k=" << k;
	}
}
