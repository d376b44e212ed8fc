// Tet file: a cursor over the bytes of a mesher's file, text and binary, and the readers that use it. Every error names
// the file and the line (in binary, the byte).
#pragma once

#include "io/import.hpp"

namespace frond {

struct TetFile {
    std::string name;  // without the folder
    std::string bytes;
    size_t at = 0;
    long line = 1;
    bool is_binary = false, is_swapped = false;  // mode of the numbers that are read next
};

// Throws FILE_FORMAT; the text gets file and line (in binary, the byte) in front.
[[noreturn]] void fail_at(const TetFile& file, const std::string& what);
bool is_at_end(const TetFile& file);
// Reads the rest of the line, without its end. Empty at the end of the file.
std::string read_line(TetFile& file);
// Skips blanks, and the end of the line behind them.
void skip_line_end(TetFile& file);
// Reads the next word of text; fails at the end of the file.
std::string read_word(TetFile& file);
// Read numbers: words in text, 4- or 8-byte values in binary.
double read_real(TetFile& file);
float read_float(TetFile& file);
int64_t read_whole(TetFile& file);  // 4 bytes
int64_t read_long(TetFile& file);   // 8 bytes
uint8_t read_byte(TetFile& file);
// Returns a count that the rest of the file can hold at `smallest` bytes each (in text at two); else fails.
size_t read_count(TetFile& file, int64_t count, size_t smallest, const char* what);

TetMesh read_gmsh(TetFile& file);
TetMesh read_vtk(TetFile& file);

// Returns the index of a region by its name; adds it on first use.
int region_index(TetMesh& mesh, const std::string& name);

}  // namespace frond
