#pragma once

namespace posidonia
{
/** Makes MRPT's archives know CObservationDVL and CObservationPressure. Apps call it before they touch a
 * rawlog: without a used symbol the linker would drop this library and its initialiser (--as-needed). MRPT's
 * own tools load it as a plug-in: rawlog-edit -p /abs/path/libposidonia-obs.so */
void registerObservations();
}  // namespace posidonia
