#include <posidonia/posegraph/pose_prior.h>

namespace posidonia
{
namespace
{
struct TKindFacts
{
	const char* name;
	int dimension;
};

const TKindFacts& factsOf(EPriorKind kind)
{
	static const TKindFacts facts[] = {
		{"position", 3}, {"horizontal position", 2}, {"depth", 1},		   {"roll/pitch", 2}, {"heading", 1},
		{"attitude", 3}, {"full pose", 6},			 {"error variable", 6}};
	return facts[int(kind)];
}
}  // namespace

const char* toString(EPriorKind kind)
{
	return factsOf(kind).name;
}

int priorDimension(EPriorKind kind)
{
	return factsOf(kind).dimension;
}
}  // namespace posidonia
