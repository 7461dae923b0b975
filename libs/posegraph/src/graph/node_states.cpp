#include <posidonia/posegraph/node_states.h>

namespace posidonia
{
void retractNode(ENodeKind kind, const Vector6d& d, int node, TNodeStates& states)
{
	if (kind == ENodeKind::ErrorVariable)
		states.values[node] += d;
	else
		states.poses[node] = orthonormalized(retract(states.poses[node], d));
}
}  // namespace posidonia
