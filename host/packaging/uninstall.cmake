# SPDX-License-Identifier: Apache-2.0
# cmake -D MANIFEST= -P: removes what the last installation put where DESTDIR says, and folders named after
# Penduline that are empty then.
if(NOT EXISTS ${MANIFEST})
  message(FATAL_ERROR "${MANIFEST}: found no such file, expected the list of what was installed from here")
endif()
file(STRINGS ${MANIFEST} files)
foreach(file ${files})
  file(REMOVE "$ENV{DESTDIR}${file}")
  get_filename_component(folder ${file} DIRECTORY)
  while(folder MATCHES "/penduline(/|$)")
    file(GLOB left "$ENV{DESTDIR}${folder}/*")
    if(NOT left AND EXISTS "$ENV{DESTDIR}${folder}")
      file(REMOVE_RECURSE "$ENV{DESTDIR}${folder}")
    endif()
    get_filename_component(folder ${folder} DIRECTORY)
  endwhile()
endforeach()
