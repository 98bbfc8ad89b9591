#include "collider/workspace.hpp"

namespace bodice::inline v0_1::collision {

Workspace::Workspace(engine::MemoryResource* memory) : data_(std::make_unique<WorkspaceData>(memory)) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

}  // namespace bodice::collision
