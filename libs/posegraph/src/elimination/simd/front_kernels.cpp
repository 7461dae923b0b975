#include "front_kernels.h"

#include <posidonia/base/error.h>

#include <cstdlib>
#include <string>

namespace posidonia
{
std::vector<const TFrontKernels*> availableFrontKernels()
{
	std::vector<const TFrontKernels*> out{&kFrontKernelsSse2};
#ifdef POSIDONIA_X86
	if (__builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma")) out.push_back(&kFrontKernelsAvx2);
	if (__builtin_cpu_supports("avx512f")) out.push_back(&kFrontKernelsAvx512);
#endif
	return out;
}

namespace
{
const TFrontKernels& choose()
{
	const auto kernels = availableFrontKernels();
	const char* wanted = std::getenv("POSIDONIA_SIMD");
	if (!wanted || !*wanted) return *kernels.back();
	std::string names;
	for (const auto* k : kernels) {
		if (std::string(wanted) == k->name) return *k;
		names += std::string(names.empty() ? "" : ", ") + k->name;
	}
	throw CError(
		"POSIDONIA_SIMD", "'" + std::string(wanted) + "' is not for this CPU",
		"leave it empty or use one of " + names);
}
}  // namespace

const TFrontKernels& frontKernels()
{
	static const TFrontKernels& kernels = choose();
	return kernels;
}
}  // namespace posidonia
