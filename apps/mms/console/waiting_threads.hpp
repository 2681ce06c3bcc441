#pragma once

namespace mms {

/// Lets OpenMP's threads sleep while they wait, before anything else is done. By default they spin,
/// and beside another busy program a picture then takes fifty times as long on two threads. OpenMP
/// reads that when it is loaded, so the program starts itself anew; not where the environment says
/// how to wait (`OMP_WAIT_POLICY`).
void let_waiting_threads_sleep(char** argv);

}  // namespace mms
