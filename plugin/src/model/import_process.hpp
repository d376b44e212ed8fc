// Import process: the program that reads mesh files for the library, so that a damaged one cannot bring down the host.
#pragma once

#include "model/import.hpp"
#include "model/import_stream.hpp"

namespace frond {

// Limits of the program; 0 chooses by the size of the file.
struct ImportLimits {
    double cpu_seconds = 0;
    double wall_seconds = 0;
    double memory_mib = 0;
    double output_mib = 0;
};

// Where the program is. Throws FILE_NOT_FOUND with the remedy if there is none.
std::string find_importer();
// Runs it on a file. Throws FILE_FORMAT or FILE_NOT_FOUND with file name and cause; the surface is neither placed nor
// clean.
Surface run_importer(const std::string& path, const ImportLimits& limits);

}  // namespace frond
