# SPDX-License-Identifier: Apache-2.0
# Man pages and completions: the built program writes them from its own options and field table, and they are installed.
# docs/configuration.md and docs/materials.md are kept with the sources: the target `reference` writes them, and a test
# fails if one is out of date.
set(pages ${CMAKE_BINARY_DIR}/pages)
file(MAKE_DIRECTORY ${pages})

# wavetracer_page(FILE DESTINATION argument...): installs the output of `wavetracer documentation argument...`. With the
# suffix .gz it is compressed without a time in it, so that the same sources give the same file.
set(page_files "")
function(wavetracer_page file destination)
  string(REGEX REPLACE "\\.gz$" "" plain ${file})
  set(pack "")
  if(NOT plain STREQUAL file)
    set(pack COMMAND gzip -9nf ${pages}/${plain})
  endif()
  add_custom_command(OUTPUT ${pages}/${file} COMMAND wavetracer documentation ${ARGN} -o ${pages}/${plain} ${pack}
    DEPENDS wavetracer VERBATIM)
  install(FILES ${pages}/${file} DESTINATION ${destination})
  set(page_files ${page_files} ${pages}/${file} PARENT_SCOPE)
endfunction()

wavetracer_page(wavetracer.1.gz ${CMAKE_INSTALL_MANDIR}/man1 --man program)
wavetracer_page(wavetracer.toml.5.gz ${CMAKE_INSTALL_MANDIR}/man5 --man config)
wavetracer_page(wavetracer ${CMAKE_INSTALL_DATADIR}/bash-completion/completions --completion bash)
wavetracer_page(_wavetracer ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions --completion zsh)
wavetracer_page(wavetracer.fish ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d --completion fish)
add_custom_target(wavetracer_pages ALL DEPENDS ${page_files})

add_custom_target(reference COMMAND wavetracer documentation --reference -o ${CMAKE_SOURCE_DIR}/docs/configuration.md
  COMMAND wavetracer documentation --materials -o ${CMAKE_SOURCE_DIR}/docs/materials.md
  COMMENT "Writing docs/configuration.md and docs/materials.md" VERBATIM)
