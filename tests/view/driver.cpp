#include "view/driver.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstring>
#include <string>
#include <vector>

#include "support/sanitized.hpp"

static int list_drivers(dl_phdr_info* object, size_t, void* names) {
    if (std::strstr(object->dlpi_name, "_dri.so"))
        static_cast<std::vector<std::string>*>(names)->push_back(object->dlpi_name);
    return 0;
}

void keep_driver() {
    if (!SANITIZED) return;
    std::vector<std::string> names;
    dl_iterate_phdr(list_drivers, &names);
    for (const std::string& name : names) dlopen(name.c_str(), RTLD_LAZY | RTLD_NOLOAD | RTLD_NODELETE);
}

// The sanitizer calls this function.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions() {
    return "leak:_dri.so\n";
}
