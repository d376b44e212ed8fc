// Makes and frees a plant's workspace.
#include "solve/workspace.hpp"

#include "core/error.hpp"

namespace frond {

WorkspacePtr make_workspace(std::shared_ptr<const System> system) {
    if (!system) fail(FROND_RESULT_INTERNAL, "a workspace was asked for without a system");
    WorkspacePtr workspace(new Workspace);
    workspace->A.set_pattern(system->elements->pattern);
    workspace->linear.block.plan = &system->plan;
    workspace->elements = system->elements.get();
    workspace->system = std::move(system);
    return workspace;
}

void use_elements(Workspace& workspace, const Elements* own) {
    workspace.elements = own ? own : workspace.system->elements.get();
}

void WorkspaceDeleter::operator()(Workspace* workspace) const {
    delete workspace;
}

}  // namespace frond
