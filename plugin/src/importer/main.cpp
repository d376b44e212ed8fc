// frond-import: reads a mesh file or a URDF file and writes its surface or tree of links to stdout as an import stream.
//     frond-import FILE [CPU_SECONDS WALL_SECONDS MEMORY_MIB [collides|seen [CORRECTIONS]]]
// With "collides" the collision meshes of a URDF file are read, not the visual ones. CORRECTIONS: a file of those, or
// empty.
// The program sets its own limits before it opens the file; its caller must expect that it may crash.
#include <cstdio>
#include <cstdlib>
#include <new>

#include "core/log.hpp"
#include "core/platform/process.hpp"
#include "importer/importer.hpp"
#include "importer/urdf.hpp"
#include "io/import_stream.hpp"

static void keep_warning(const char* message, void* result) {
    static_cast<frond::ImportResult*>(result)->warnings.push_back(message);
}

static void read_file(const std::string& path, frond::UrdfUse use, const std::string& corrections,
                      frond::ImportResult& result) {
    using namespace frond;
    try {
        const MeshFile file = open_file(path);
        check_file(file);
        if (file.format == FileFormat::URDF)
            result.tree = read_urdf(file, use);
        else
            result.surface = file.format == FileFormat::PLY ? read_ply(file) : read_scene(file);
        if (!corrections.empty()) result.corrections = read_corrections(corrections);
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
    result.corrections = Corrections();
}

int main(int count, char** words) {
    const std::vector<std::string> arguments = frond::own_arguments(count, words);
    if (arguments.size() < 2 || frond::is_output_a_terminal()) {
        fprintf(stderr,
                "frond-import reads a mesh file for the Frond library and writes to a pipe; use the frond command\n");
        return 2;
    }
    const auto number = [&](size_t i) {
        return arguments.size() > i ? double(strtol(arguments[i].c_str(), nullptr, 10)) : 0.0;
    };
    frond::limit_self({number(2), number(3), number(4)});
    if (!frond::write_output(frond::import_greeting())) return 1;
    frond::ImportResult result;
    frond::set_log(keep_warning, &result);
    const bool collides = arguments.size() > 5 && arguments[5] == "collides";
    read_file(arguments[1], collides ? frond::UrdfUse::COLLIDES : frond::UrdfUse::SEEN,
              arguments.size() > 6 ? arguments[6] : "", result);
    const bool written = frond::write_output(frond::encode_import(result));
    // Skips the destructors: a scene that may be half damaged need not be torn down.
    frond::leave(written ? 0 : 1);
}
