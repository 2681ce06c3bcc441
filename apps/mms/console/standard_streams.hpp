#pragma once

namespace mms {

/// Opens /dev/null for standard streams that are closed; to be called first in main. Otherwise the
/// next opened file would get their descriptor, and messages would be written into it. Writing to a
/// standard output that was closed still fails.
void open_missing_streams();

/// Writes what is buffered for the standard output.
/// @returns whether all output was written
bool flush_output();

}  // namespace mms
