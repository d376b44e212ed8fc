# frond run writes a picture, frames, a contact sheet and a moving picture.
file(REMOVE_RECURSE ${OUT})
file(MAKE_DIRECTORY ${OUT})
execute_process(COMMAND ${FROND} run drag --steps 8 --every 4 --width 160 --height 120 --shot ${OUT}/shot.png
                        --frames ${OUT}/frames COMMAND_ERROR_IS_FATAL ANY)
foreach(file shot.png frames/frame_0000.png frames/frame_0001.png frames/sheet.png frames/film.webp)
    if(NOT EXISTS ${OUT}/${file})
        message(FATAL_ERROR "${file} was not written")
    endif()
    file(SIZE ${OUT}/${file} size)
    if(size LESS 500)
        message(FATAL_ERROR "${file} has ${size} bytes only")
    endif()
endforeach()
