// Tet file: a cursor over the bytes of a mesher's file, text and binary, and the readers that use it. Every error names
// the file and, in text, the line.
#pragma once

#include "model/import.hpp"

namespace frond {

struct TetFile {
    std::string name;  // without the folder
    std::string bytes;
    size_t at = 0;
    long line = 1;
    bool is_binary = false, is_swapped = false;  // of the numbers now read
};

// Throws FILE_FORMAT; the text gets file and line in front.
[[noreturn]] void fail_at(const TetFile& file, const std::string& what);
bool is_at_end(const TetFile& file);
// The rest of the line, without its end. Empty at the end of the file.
std::string read_line(TetFile& file);
// Blanks, and the end of the line behind them.
void skip_line_end(TetFile& file);
// The next word of text; fails at the end of the file.
std::string read_word(TetFile& file);
// Numbers: words in text, 4- or 8-byte values in binary.
double read_real(TetFile& file);
float read_float(TetFile& file);
int64_t read_whole(TetFile& file);  // 4 bytes
int64_t read_long(TetFile& file);   // 8 bytes
uint8_t read_byte(TetFile& file);
// A count that the rest of the file can hold at `smallest` bytes each (in text at two).
size_t read_count(TetFile& file, int64_t count, size_t smallest, const char* what);

TetMesh read_gmsh(TetFile& file);
TetMesh read_vtk(TetFile& file);

// Index of a region by its name, added on first use.
int region_index(TetMesh& mesh, const std::string& name);

}  // namespace frond
