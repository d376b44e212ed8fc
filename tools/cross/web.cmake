# Builds for browsers by Debian's Emscripten: WebAssembly with its own exceptions and vectors of two lanes.
include(/usr/share/emscripten/cmake/Modules/Platform/Emscripten.cmake)
foreach(kind LIBRARY INCLUDE PACKAGE)
    set(CMAKE_FIND_ROOT_PATH_MODE_${kind} BOTH)
endforeach()
add_compile_options(-fwasm-exceptions -msimd128)
add_link_options(-fwasm-exceptions)
