(* Library AsXml: XML read from memory and written into it; its function blocks, with the names, types and order that B&R gives them. *)

FUNCTION_BLOCK xmlCreateMemoryReader (*makes a reader*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		pXmlMemory : UDINT; (*address of the XML*)
		memorySize : UDINT; (*bytes of it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*of the reader or writer*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlCloseMemoryReader (*ends a reader*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlReadNextNode (*reads the next node*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		forceRead : BOOL; (*go on, though the last node did not fit*)
		skipSubtree : BOOL; (*leave out what is inside the last node*)
		pName : UDINT; (*where its name goes*)
		nameSize : UDINT; (*bytes there are for it*)
		pValue : UDINT; (*where its value goes*)
		valueSize : UDINT; (*bytes there are for it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
		nodeType : UDINT; (*xmlNODE_TYPE_...*)
		depth : UDINT; (*0 for the root*)
		isEmpty : BOOL; (*an element without an end of its own*)
		attributeCount : UDINT;
		neededNameSize : UDINT;
		neededValueSize : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlReadAttributeNr (*reads an attribute of the node*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		index : UDINT; (*from 0 on*)
		pName : UDINT; (*where its name goes*)
		nameSize : UDINT; (*bytes there are for it*)
		pValue : UDINT; (*where its value goes*)
		valueSize : UDINT; (*bytes there are for it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
		neededNameSize : UDINT;
		neededValueSize : UDINT;
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlCreateMemoryWriter (*makes a writer*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
		ident : UDINT; (*of the reader or writer*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlGetMemoryInfo (*where the XML lies that was written*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
		pXmlData : UDINT; (*its address*)
		xmlDataSize : UDINT; (*bytes of it*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlCloseMemoryWriter (*ends a writer*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteStartDocument (*writes the declaration*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pVersion : UDINT; (*address, 0 for 1.0*)
		pEncoding : UDINT; (*address, 0 for UTF-8*)
		pStandalone : UDINT; (*address, 0 for none*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteStartDocEnc (*writes the declaration; texts are converted*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pVersion : UDINT; (*address, 0 for 1.0*)
		pInputEncoding : UDINT; (*of the texts*)
		pOutputEncoding : UDINT; (*of the XML*)
		pStandalone : UDINT; (*address, 0 for none*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteEndDocument (*ends all elements*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteStartElement (*begins an element*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pName : UDINT; (*address of its name*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteAttribute (*adds an attribute*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pName : UDINT; (*address of its name*)
		pValue : UDINT; (*address of its value*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteElementText (*writes a text*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pText : UDINT; (*address of it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteElementTextEx (*writes a text of a length*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pText : UDINT; (*address of it*)
		textLen : UDINT; (*bytes*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteEndElement (*ends the element*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteComment (*writes a comment*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pText : UDINT; (*address of it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteCommentEx (*writes a comment of a length*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pText : UDINT; (*address of it*)
		textLen : UDINT; (*bytes*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteCData (*writes a CDATA section*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pCData : UDINT; (*address of it*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWriteCDataEx (*writes a CDATA section of a length*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pCData : UDINT; (*address of it*)
		cdataLen : UDINT; (*bytes*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK

FUNCTION_BLOCK xmlWritePI (*writes a processing instruction*)
	VAR_INPUT
		enable : BOOL; (*run the block*)
		ident : UDINT; (*of the reader or writer*)
		pTarget : UDINT; (*address of its target*)
		pValue : UDINT; (*address of its value*)
	END_VAR
	VAR_OUTPUT
		status : UINT; (*0, ERR_FUB_ENABLE_FALSE or an error*)
	END_VAR
END_FUNCTION_BLOCK
