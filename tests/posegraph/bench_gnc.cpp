#include <posidonia/posegraph/graduated_nonconvexity.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

#include "generated_sphere.h"

using namespace posidonia;
using namespace posidonia::testing;

/** Generated spheres with 30 % wrong loops: bench_gnc [rings=50] [seeds=10] [noise=1]. One row a seed. */
int main(int argc, char** argv)
{
	const int rings = argc > 1 ? std::atoi(argv[1]) : 50, seeds = argc > 2 ? std::atoi(argv[2]) : 10;
	const double noise = argc > 3 ? std::atof(argv[3]) : 1;
	std::printf("seed  odometry  oracle     GNC   ratio  found%%  refused%%  rounds  CPU s\n");
	for (int seed = 1; seed <= seeds; seed++) {
		auto sphere = generatedSphere(unsigned(seed), rings, noise, 0.3);
		CPoseGraph oracle = trueEdgesOnly(sphere);
		CSparseOptimizer().optimize(oracle);
		const double odometry = meanPositionError(sphere.graph, sphere.truth);
		const std::clock_t start = std::clock();
		const auto result = CGraduatedNonconvexity().optimize(sphere.graph);
		const double cpu = double(std::clock() - start) / CLOCKS_PER_SEC;
		double wrong = 0, found = 0, refused = 0;
		for (size_t k = 0; k < sphere.wrong.size(); k++) {
			wrong += sphere.wrong[k];
			(sphere.wrong[k] ? found : refused) += result.edge_weights[k] == 0;
		}
		const double loops = double(sphere.graph.edgeCount() - sphere.truth.size() + 1);
		const double e0 = meanPositionError(oracle, sphere.truth),
					 e = meanPositionError(sphere.graph, sphere.truth);
		std::printf(
			"%4d  %8.3f  %6.3f  %6.3f  %6.3f  %6.2f  %8.2f  %6d  %5.1f\n", seed, odometry, e0, e, e / e0,
			100 * found / wrong, 100 * refused / (loops - wrong), result.rounds, cpu);
		std::fflush(stdout);
	}
}
