// Entry of the program `ident`: finds the subcommand, turns errors into exit status.
int main() { return 0; }
