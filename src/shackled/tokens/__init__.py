"""Collections of tokens whose pictures are computed on chain."""
