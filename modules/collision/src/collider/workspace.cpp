#include "collider/workspace.hpp"

namespace bodice::inline v0_1::collision {

Workspace::Workspace() : data_(std::make_unique<WorkspaceData>()) {}
Workspace::~Workspace() = default;
Workspace::Workspace(Workspace&&) noexcept = default;
Workspace& Workspace::operator=(Workspace&&) noexcept = default;

}  // namespace bodice::collision
