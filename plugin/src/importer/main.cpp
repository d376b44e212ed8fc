// frond-import: reads a mesh file or a URDF file and writes its surface or tree of links to stdout as an import stream.
//     frond-import FILE [CPU_SECONDS WALL_SECONDS MEMORY_MIB [collides]]
// With "collides" the collision meshes of a URDF file are read, not the visual ones.
// The program sets its own limits before it opens the file; its caller must expect that it may crash.
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <new>

#include "core/log.hpp"
#include "importer/importer.hpp"
#include "importer/urdf.hpp"
#include "model/import_stream.hpp"

#if defined(__SANITIZE_ADDRESS__)
static constexpr bool LIMITS_MEMORY = false;  // the sanitizer reserves terabytes
#else
static constexpr bool LIMITS_MEMORY = true;
#endif

static void limit(int resource, rlim_t amount) {
    rlimit values;
    if (getrlimit(__rlimit_resource_t(resource), &values) != 0) return;
    values.rlim_cur = values.rlim_max == RLIM_INFINITY ? amount : std::min(amount, values.rlim_max);
    setrlimit(__rlimit_resource_t(resource), &values);
}

static void limit_self(int argument_count, char** arguments) {
    const long cpu = argument_count > 2 ? strtol(arguments[2], nullptr, 10) : 0;
    const long wall = argument_count > 3 ? strtol(arguments[3], nullptr, 10) : 0;
    const long memory = argument_count > 4 ? strtol(arguments[4], nullptr, 10) : 0;
    prctl(PR_SET_PDEATHSIG, SIGKILL);
    limit(RLIMIT_CORE, 0);
    if (cpu > 0) limit(RLIMIT_CPU, rlim_t(cpu));
    if (wall > 0) alarm(unsigned(wall));
    if (memory > 0 && LIMITS_MEMORY) limit(RLIMIT_AS, rlim_t(memory) << 20);
}

static bool write_all(const std::string& bytes) {
    size_t at = 0;
    while (at < bytes.size()) {
        const ssize_t count = write(STDOUT_FILENO, bytes.data() + at, bytes.size() - at);
        if (count <= 0) return false;
        at += size_t(count);
    }
    return true;
}

static void keep_warning(const char* message, void* result) {
    static_cast<frond::ImportResult*>(result)->warnings.push_back(message);
}

static void read_file(const std::string& path, frond::UrdfUse use, frond::ImportResult& result) {
    using namespace frond;
    try {
        const MeshFile file = open_file(path);
        check_file(file);
        if (file.format == FileFormat::URDF)
            result.tree = read_urdf(file, use);
        else
            result.surface = file.format == FileFormat::PLY ? read_ply(file) : read_scene(file);
    } catch (const Error& error) {
        result.code = error.code;
        result.error = error.what();
    } catch (const std::bad_alloc&) {
        result.code = FROND_RESULT_FILE_FORMAT;
        result.error = "the file needs more memory than is allowed: it is damaged or far too large";
    } catch (const std::exception& error) {
        result.code = FROND_RESULT_FILE_FORMAT;
        result.error = std::string("the file could not be read: ") + error.what();
    }
    if (result.code == FROND_OK) return;
    result.surface = Surface();
    result.tree = UrdfTree();
}

int main(int argument_count, char** arguments) {
    if (argument_count < 2 || isatty(STDOUT_FILENO)) {
        fprintf(stderr,
                "frond-import reads a mesh file for the Frond library and writes to a pipe; use the frond command\n");
        return 2;
    }
    limit_self(argument_count, arguments);
    if (!write_all(frond::import_greeting())) return 1;
    frond::ImportResult result;
    frond::set_log(keep_warning, &result);
    const bool collides = argument_count > 5 && strcmp(arguments[5], "collides") == 0;
    read_file(arguments[1], collides ? frond::UrdfUse::COLLIDES : frond::UrdfUse::SEEN, result);
    const bool written = write_all(frond::encode_import(result));
    // Skips the destructors: a scene that may be half damaged need not be torn down.
    _exit(written ? 0 : 1);
}
