// Import process: the program that reads mesh files for the library, so that a damaged file cannot crash the host.
#pragma once

#include "io/import.hpp"
#include "io/import_stream.hpp"

namespace frond {

// Limits of the program; 0: chosen by the size of the file.
struct ImportLimits {
    double cpu_seconds = 0;
    double wall_seconds = 0;
    double memory_mib = 0;
    double output_mib = 0;
};

// Returns the path of the program. Throws FILE_NOT_FOUND with the remedy if there is none.
std::string find_importer();
// Runs the program on a file. Throws FILE_FORMAT or FILE_NOT_FOUND with file name and cause; the surface is neither
// placed nor clean.
Surface run_importer(const std::string& path, const ImportLimits& limits);

}  // namespace frond
