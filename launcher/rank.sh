#!/bin/sh
# rank.sh FOLDER [ARGUMENT ...]
# pytest on one MPI rank; started by mpirun, see tests.sh. Rank 0 reports; what the others say is kept for the case
# that they fail. An ordinary exit code of pytest goes to a file, because mpirun would end the other rank, before it
# could report, at the first nonzero one. After a crash that is just right: the other rank would wait for ever.
folder=$1
shift
rank=${OMPI_COMM_WORLD_RANK:-${PMI_RANK:-0}}
if [ "$rank" != 0 ]; then exec >"$folder/output" 2>&1; fi
status=0
python -m pytest "$@" || status=$?
echo "$status" >"$folder/status-$rank"
if [ "$status" -gt 5 ]; then exit "$status"; fi
