// Grow, OBJ files. In: a plant. Out: the text of its OBJ and MTL files (Wavefront). Numbers are printed digit by digit,
// so that no locale can change a byte.
#include <cerrno>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "grow.hpp"

namespace frond::grow {
namespace {

const char* const VERSION_LINE = "# Frond grow, format 1\n";

// Prints a number rounded to a number of decimals; minus zero prints as zero.
void print_fixed(std::string& text, double value, int decimals) {
    long long scale = 1;
    for (int i = 0; i < decimals; i++) scale *= 10;
    long long n = std::llround(value * static_cast<double>(scale));
    if (n < 0) text += '-', n = -n;
    text += std::to_string(n / scale);
    text += '.';
    const std::string digits = std::to_string(n % scale);
    text.append(decimals - digits.size(), '0');
    text += digits;
}

void print_numbers(std::string& text, const double* values, int count, int decimals) {
    for (int i = 0; i < count; i++) text += ' ', print_fixed(text, values[i], decimals);
}

void write_file(const std::filesystem::path& path, const std::string& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    if (!file) throw std::runtime_error("cannot write " + path.string() + ": " + std::strerror(errno));
}

}  // namespace

std::string obj_text(const GrownPlant& plant, const std::string& library) {
    std::string text = VERSION_LINE;
    text += "# " + plant.kind + ": " + std::to_string(plant.positions.size()) + " vertices, " +
            std::to_string(plant.triangles.size()) + " triangles; metres, +y up\nmtllib " + library + "\n";
    int map_count = 0;  // texture coordinates are numbered over the textured organs only
    for (const GrownOrgan& organ : plant.organs) {
        const GrownMaterial& material = plant.materials[organ.material];
        const bool textured = !material.texture.empty();
        text += "o " + organ.name + "\nusemtl " + material.name + "\n";
        for (int v = organ.first_vertex; v < organ.first_vertex + organ.vertex_count; v++) {
            text += 'v';
            print_numbers(text, plant.positions[v].data(), 3, 5);
            print_numbers(text, plant.colors[v].data(), 3, 3);
            text += '\n';
        }
        for (int v = organ.first_vertex; textured && v < organ.first_vertex + organ.vertex_count; v++) {
            text += "vt";
            print_numbers(text, plant.uvs[v].data(), 2, 4);
            text += '\n';
        }
        for (int t = organ.first_triangle; t < organ.first_triangle + organ.triangle_count; t++) {
            text += 'f';
            for (int corner : plant.triangles[t]) {
                text += ' ' + std::to_string(corner + 1);
                if (textured) text += '/' + std::to_string(map_count + corner - organ.first_vertex + 1);
            }
            text += '\n';
        }
        if (textured) map_count += organ.vertex_count;
    }
    return text;
}

std::string mtl_text(const GrownPlant& plant) {
    std::string text = VERSION_LINE;
    for (const GrownMaterial& material : plant.materials) {
        text += "newmtl " + material.name + "\nKd";
        print_numbers(text, material.color.data(), 3, 3);
        text += "\n";
        if (!material.texture.empty()) text += "map_Kd " + material.texture + "\n";
    }
    return text;
}

std::string write_obj(const GrownPlant& plant, const std::string& folder) {
    const std::filesystem::path base(folder);
    std::error_code error;
    std::filesystem::create_directories(base, error);
    if (error) throw std::runtime_error("cannot make folder " + folder + ": " + error.message());
    for (const GrownImage& image : plant.images) write_file(base / image.name, png_bytes(image));
    write_file(base / (plant.kind + ".mtl"), mtl_text(plant));
    const std::filesystem::path path = base / (plant.kind + ".obj");
    write_file(path, obj_text(plant, plant.kind + ".mtl"));
    return path.string();
}

}  // namespace frond::grow
