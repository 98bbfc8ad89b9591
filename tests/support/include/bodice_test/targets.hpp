// Runs a test on every instruction set of this machine.
#pragma once

#include <string>

#include <bodice/engine/function_ref.hpp>

namespace bodice_test {

/// Calls `body` (name of the instruction set) once for every instruction set of this machine.
void on_every_target(bodice::engine::FunctionRef<void(const std::string&)> body);

}  // namespace bodice_test
