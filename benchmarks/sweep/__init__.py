"""Many tanks that differ in one number: this solver's sweep, and a loop over the script on NGSolve."""
