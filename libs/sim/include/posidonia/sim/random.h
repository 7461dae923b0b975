#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>
#include <string>

namespace posidonia
{
/** A well mixed 64-bit hash of a counter (splitmix64's finaliser, Steele et al. 2014). */
inline uint64_t mixed(uint64_t x)
{
	x += 0x9E3779B97F4A7C15ull;
	x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
	x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
	return x ^ (x >> 31);
}

/** Hash of several numbers, order matters. */
template <class... REST>
uint64_t mixed(uint64_t first, uint64_t second, REST... rest)
{
	return mixed(mixed(first) ^ second, static_cast<uint64_t>(rest)...);
}

/** Number in [0, 1) of a hash. */
inline double unitInterval(uint64_t hash)
{
	return static_cast<double>(hash >> 11) * 0x1.0p-53;
}

/** Own seed of a part called `name`: switching one part off leaves the others' numbers alone. */
inline uint64_t seedOf(uint64_t seed, const std::string& name)
{
	uint64_t h = mixed(seed);
	for (const char c : name)
		h = mixed(h ^ static_cast<unsigned char>(c));
	return h;
}

/** White Gaussian numbers from an own generator. */
class CNoise
{
   public:
	explicit CNoise(uint64_t seed) : m_generator(seed) {}
	double normal() { return m_normal(m_generator); }
	/** N of them, the first drawn first. */
	template <int N>
	Eigen::Matrix<double, N, 1> normals()
	{
		Eigen::Matrix<double, N, 1> x;
		for (int i = 0; i < N; i++)
			x[i] = normal();
		return x;
	}
	double uniform(double lo, double hi) { return lo + (hi - lo) * unitInterval(m_generator()); }

   private:
	std::mt19937_64 m_generator;
	std::normal_distribution<double> m_normal;
};
}  // namespace posidonia
